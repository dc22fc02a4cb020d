/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpClearanceSearch.h
 * \brief Clearance of a true motion at every instant, not at samples.
 */
#ifndef vpClearanceSearch_h
#define vpClearanceSearch_h

#include "lab/avoidance/vpTrueScene.h"

#include <visp3/avoidance/vpReachBounds.h>

BEGIN_VISP_NAMESPACE

//! \brief A place on the true motion; the joints move at constant velocity from one to the next.
struct vpMotionKnot {
  double time = 0.;
  vpJointVector q;
};

//! \brief What the search finds.
struct vpClearanceHistory {
  double least = 0.;          //!< m, to 0.1 mm, at most vpClearanceSearch::horizon.
  int collisionsMoving = 0;   //!< Touches during which the arm moved.
  int collisionsStanding = 0; //!< Touches during which it did not.
};

/*!
 * \brief Looks for the least clearance between the knots where bounds on the motion of arm and obstacles leave room for
 * it.
 */
class vpClearanceSearch
{
public:
  static constexpr double horizon = 1.;          //!< m: clearances beyond it are not told apart.
  static constexpr double tolerance = 1e-4;      //!< m: the least clearance is known to it.
  static constexpr double movingVelocity = 0.01; //!< rad/s or m/s: an arm whose joints are slower stands.

  explicit vpClearanceSearch(const vpAvoidanceRunSpec &spec);

  //! Of a whole motion; at least one knot.
  [[nodiscard]] vpClearanceHistory search(const std::vector<vpMotionKnot> &knots);
  /*!
   * True when no pair comes nearer than \e distance, m, while the joints keep \e velocity from \e q on for \e duration,
   * s, each until its position limit.
   */
  [[nodiscard]] bool isFreeAhead(double time, const vpJointVector &q, const vpJointVector &velocity, double duration,
                                 double distance);
  //! The same for configurations in equal steps of time; looked at in these alone.
  [[nodiscard]] bool isFreeAlong(double time, const std::vector<vpJointVector> &way, double duration, double distance);

private:
  struct Interval {
    const vpMotionKnot *from, *to;
    double *least;
    bool touched;
  };
  [[nodiscard]] double at(double time, const vpJointVector &q);
  [[nodiscard]] double motion(const vpJointVector &dq, double dt) const;
  void split(Interval &interval, double s0, double c0, double s1, double c1);

  vpTrueScene m_truth;
  vpReachBounds m_reach;
  vpCollisionData m_data;
};

END_VISP_NAMESPACE
#endif
