/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPathSearch.h
 * \brief What vpPathPlanner calls for a path between two free configurations.
 */
#ifndef vpPathSearch_h
#define vpPathSearch_h

#include "vpMotionCheck.h"

#include <chrono>
#include <functional>
#include <memory>

BEGIN_VISP_NAMESPACE

//! Seconds since a point of time.
inline double vpSecondsSince(const std::chrono::steady_clock::time_point &start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

//! Ends of a path, free and within the limits, and the box in which it is searched.
struct vpPathProblem {
  vpJointVector start, goal, lower, upper; //!< n numbers each, rad or m.
};

//! A method that searches paths. One object per thread.
class vpPathSearch
{
public:
  virtual ~vpPathSearch() = default;
  /*!
   * Searches a path of motions that the check found free, and shortens it.
   * \param problem : The straight motion is known not to be free.
   * \param spec : Parameters of the planner; limits and seed may differ from call to call.
   * \param result : Receives all but the message; status Solved, TimedOut or NotFree, a path only with Solved.
   */
  virtual void search(const vpPathProblem &problem, const vpPathPlannerSpec &spec, vpPathResult &result) = 0;
};

//! Makes a search; the check must outlive it.
using vpPathSearchMaker = std::function<std::unique_ptr<vpPathSearch>(vpMotionCheck &check)>;

END_VISP_NAMESPACE
#endif
