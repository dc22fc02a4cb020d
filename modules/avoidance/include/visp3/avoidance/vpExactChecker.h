/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpExactChecker.h
 * \brief Collision queries by capsules first, and by exact shapes where capsules touch.
 */
#ifndef vpExactChecker_h
#define vpExactChecker_h

#include <visp3/avoidance/vpCollisionChecker.h>

#include <memory>

BEGIN_VISP_NAMESPACE

class vpExactQuery;

/*!
 * \class vpExactChecker
 * \ingroup group_avoidance
 * \brief Collision checker for planning: pairs that the capsules of a scene do not prove free are decided by the exact
 * shapes of vpCollisionSceneSpec::exact, where both parts have one. Without exact shapes the same as vpSceneChecker.
 *
 * A pair of two exact shapes that touch has the distance 0, whatever the depth. Takes some 50 us for each pair whose
 * capsules touch. Allocates.
 *
 * \code
 * vpCollisionSceneSpec spec;
 * spec.exact = std::make_shared<vpExactShapes>(arm);
 * const vpCollisionScene exact(arm, spec);
 * vpExactChecker checker(exact);
 * if (checker.inCollision(q, 0.01)) { // margin, m
 *   std::cerr << exact.describe(checker.clearance(q, 0.02)) << std::endl;
 * }
 * \endcode
 */
class VISP_EXPORT vpExactChecker : public vpCollisionChecker
{
public:
  //! \param scene : Must outlive the checker. Objects may be moved, added and removed between the calls.
  explicit vpExactChecker(const vpCollisionScene &scene);
  ~vpExactChecker() VP_OVERRIDE;
  vpExactChecker(const vpExactChecker &) = delete;
  vpExactChecker &operator=(const vpExactChecker &) = delete;

  [[nodiscard]] int jointCount() const noexcept VP_OVERRIDE { return m_scene->arm().size(); }
  [[nodiscard]] bool inCollision(const vpJointVector &q, double margin) VP_OVERRIDE;
  [[nodiscard]] vpClearance clearance(const vpJointVector &q, double cutoff) VP_OVERRIDE;

private:
  [[nodiscard]] vpClearance exactClearance(double cutoff);

  const vpCollisionScene *m_scene;
  vpCollisionData m_data;
  std::unique_ptr<vpExactQuery> m_query;
};

END_VISP_NAMESPACE
#endif
