/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpAvoidanceEvaluation.h
 * \brief Metrics of an avoidance experiment; clearance of a true motion at every instant, not only at samples.
 */
#ifndef vpAvoidanceEvaluation_h
#define vpAvoidanceEvaluation_h

#include "lab/avoidance/vpAvoidanceExperiment.h"
#include "lab/avoidance/vpTrueScene.h"

#include <visp3/avoidance/vpReachBounds.h>

BEGIN_VISP_NAMESPACE

//! \brief A knot of the true motion; the joints move at constant velocity between knots.
struct vpMotionKnot {
  double time = 0.;
  vpJointVector q;
};

//! \brief Result of the search.
struct vpClearanceHistory {
  double least = 0.;          //!< Least clearance, m, to 0.1 mm, at most vpClearanceSearch::horizon.
  int collisionsMoving = 0;   //!< Number of contacts during which the arm moved.
  int collisionsStanding = 0; //!< Number of contacts during which it stood.
};

/*!
 * \brief Searches the least clearance between knots by branch and bound with motion bounds of arm and obstacles.
 */
class vpClearanceSearch
{
public:
  static constexpr double horizon = 1.;          //!< Clearances beyond it are not distinguished, m.
  static constexpr double tolerance = 1e-4;      //!< Accuracy of the least clearance, m.
  static constexpr double movingVelocity = 0.01; //!< An arm with all joints slower stands, rad/s or m/s.

  explicit vpClearanceSearch(const vpAvoidanceRunSpec &spec);

  //! Searches a whole motion of at least one knot.
  [[nodiscard]] vpClearanceHistory search(const std::vector<vpMotionKnot> &knots);
  /*!
   * True if no pair comes nearer than \e distance, m, while the joints keep \e velocity from \e q on for \e duration,
   * s, each until its position limit.
   */
  [[nodiscard]] bool isFreeAhead(double time, const vpJointVector &q, const vpJointVector &velocity, double duration,
                                 double distance);
  //! True if no pair comes nearer than \e distance at configurations in equal time steps; checked only there.
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
  std::shared_ptr<const vpReachBounds> m_reach;
  vpCollisionData m_data;
};

namespace vpAvoidanceEvaluation
{
//! True if the tool is at the goal and the joints are commanded to rest.
[[nodiscard]] bool isThere(const vpAvoidanceRunSpec &spec, const vpAvoidanceSample &sample);
//! True if the joints are commanded to rest.
[[nodiscard]] bool isAtRest(const vpJointVector &command);
//! Computes all metrics. \param knots : The true motion.
[[nodiscard]] vpAvoidanceMetrics evaluate(const vpAvoidanceRun &run, const std::vector<vpMotionKnot> &knots);
} // namespace vpAvoidanceEvaluation

END_VISP_NAMESPACE
#endif
