/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPathPlanner.h
 * \brief Ways round obstacles in joint space, by the planners of OMPL. Needs OMPL when the module is built.
 */
#ifndef vpPathPlanner_h
#define vpPathPlanner_h

#include <visp3/avoidance/vpCollisionScene.h>
#include <visp3/avoidance/vpJointPath.h>

#include <memory>
#include <string>

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief How a planner looks at the motion between two configurations.
enum class vpMotionValidation {
  Certified,  //!< vpCertifiedMotion: what counts as free is proven free. The default.
  Discrete,   //!< vpDiscreteMotion on the fast path: samples, what lies between them is not seen.
  DiscreteFcl //!< vpDiscreteMotion on FCL, as most planners are set up; needs FCL when the module is built.
};

/*!
 * \ingroup group_avoidance
 * \brief Parameters of vpPathPlanner.
 */
struct VISP_EXPORT vpPathPlannerSpec {
  //! One of vpPathPlanner::names(). RRTConnect is the quickest here; RRT*, BIT* go on improving until time is up.
  std::string planner = "RRTConnect";
  vpMotionValidation validation = vpMotionValidation::Certified; //!< Of motions.
  double margin = 0.005;                                         //!< Clearance kept, m, >= 0.
  double step = 0.05;    //!< Discrete validation: largest change of a joint between samples, rad or m, > 0.
  double timeLimit = 2.; //!< For planning, s, > 0.
  //! Planning ends after so many rounds of the planner's loop, too; 0: only with the time. Repeats on any machine.
  unsigned int iterations = 0;
  bool stopAtFirst = true;  //!< RRT* and BIT*: false goes on improving until the time is up.
  double range = 0.;        //!< Longest motion of a tree, rad or m, >= 0; 0: OMPL chooses.
  double shortenTime = 0.2; //!< Longest time for making a found way shorter (OMPL's PathSimplifier), s, >= 0; 0: none.
  unsigned int seed = 1;    //!< Of the sampling, >= 1. Runs repeat where no time limit ends them.

  /*!
   * \throw vpException (badValue) naming the field that is out of range, and its value; an unknown planner with the
   * known ones.
   */
  void validate() const;
};

//! \ingroup group_avoidance
//! \brief How planning ended.
enum class vpPathStatus {
  Solved,           //!< There is a path.
  StartInCollision, //!< The start is nearer to an obstacle, the ground or itself than the margin.
  GoalInCollision,  //!< The goal is.
  OutsideLimits,    //!< Start or goal is outside the position limits.
  TimedOut,         //!< No path was found in time; that is no proof that there is none.
  BadInput          //!< A configuration of the wrong size or not finite.
};

/*!
 * \ingroup group_avoidance
 * \brief What a planner found.
 */
struct VISP_EXPORT vpPathResult {
  vpPathStatus status = vpPathStatus::BadInput; //!< Only Solved has a path.
  vpJointPath path;                             //!< From start to goal; a continuous joint may pass +-pi.
  double planningTime = 0.;                     //!< s.
  double shortenTime = 0.;                      //!< s.
  long motions = 0;                             //!< Motions that were checked.
  std::string sentence;                         //!< For a person, with the pair that is in the way.
};

/*!
 * \class vpPathPlanner
 * \ingroup group_avoidance
 * \brief Plans in the joint space of a scene's arm, by OMPL \cite Sucan12. Objects count where they stand when plan() is called.
 *
 * Continuous joints take the short way round to the goal's angle; the path never crosses position limits. A path found
 * with certified validation is free with the margin at every point of it, thesis (3.46), (3.48); with the discrete ones
 * it may not be. One object for each thread.
 */
class VISP_EXPORT vpPathPlanner
{
public:
  //! RRT, RRTConnect, RRTstar, PRM, BITstar, KPIECE.
  [[nodiscard]] static const std::vector<std::string> &names();

  /*!
   * \param scene : Must outlive the planner.
   * \param spec : Parameters; copied.
   * \throw vpException (badValue), see vpPathPlannerSpec::validate(); (notImplementedError) naming FCL when it was
   * missing.
   */
  explicit vpPathPlanner(const vpCollisionScene &scene, const vpPathPlannerSpec &spec = {});
  ~vpPathPlanner();
  vpPathPlanner(vpPathPlanner &&) noexcept;            //!< Moves.
  vpPathPlanner &operator=(vpPathPlanner &&) noexcept; //!< Moves.
  vpPathPlanner(const vpPathPlanner &) = delete;
  vpPathPlanner &operator=(const vpPathPlanner &) = delete;

  //! Plans from \e start to \e goal (n numbers each, rad or m). What is beyond a position limit L by no more than
  //! 1e-9 max(1, |L|) counts as at it. Allocates.
  [[nodiscard]] vpPathResult plan(const vpJointVector &start, const vpJointVector &goal);
  //! Changes the longest time for planning, s; values that are not > 0 are left out.
  void setTimeLimit(double seconds) noexcept;
  //! Changes the seed, so that another try is another try; 0 is left out.
  void setSeed(unsigned int seed) noexcept;
  //! The parameters.
  [[nodiscard]] const vpPathPlannerSpec &spec() const noexcept;

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
