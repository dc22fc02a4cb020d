/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpDiscreteMotion.h
 * \brief Conventional motion check by samples at a fixed step, for comparison.
 */
#ifndef vpDiscreteMotion_h
#define vpDiscreteMotion_h

#include <visp3/avoidance/vpCollisionChecker.h>
#include <visp3/avoidance/vpMotionResult.h>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpDiscreteMotion
 * \ingroup group_avoidance
 * \brief Discrete motion check: samples configurations at most a step apart, the middle first as OMPL does. Collisions
 * between samples are missed: "free" may be wrong.
 *
 * \code
 * vpSceneChecker checker(scene);
 * vpDiscreteMotion motions(checker, 0.02, 0.01); // step, rad; margin, m
 * const vpMotionResult result = motions.check(q, goal);
 * std::cout << result.message() << " " << result.evaluated << " configurations" << std::endl;
 * \endcode
 */
class VISP_EXPORT vpDiscreteMotion
{
public:
  /*!
   * \param checker : Fast path or FCL; must outlive this.
   * \param step : Largest change of a joint between samples, rad or m, > 0.
   * \param margin : Clearance margin, m, >= 0, see vpCertifiedMotionSpec.
   * \throw vpException (badValue) naming step or margin and its value.
   */
  explicit vpDiscreteMotion(vpCollisionChecker &checker, double step = 0.05, double margin = 0.);
  //! Checks the motion, both ends included.
  [[nodiscard]] vpMotionResult check(const vpJointVector &from, const vpJointVector &to);

private:
  vpCollisionChecker *m_checker;
  double m_step;
  double m_margin;
};

END_VISP_NAMESPACE
#endif
