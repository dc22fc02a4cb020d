/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFclChecker.h
 * \brief Collision queries by FCL, for comparison. Requires a build with FCL.
 */
#ifndef vpFclChecker_h
#define vpFclChecker_h

#include <visp3/avoidance/vpCollisionChecker.h>

#include <memory>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpFclChecker
 * \ingroup group_avoidance
 * \brief Checks all pairs of a scene by FCL 0.7 \cite Pan12 : an independent implementation, slower and less exact than
 * the fast path.
 *
 * Its capsule-box distances err by up to 1 mm; meshes are surfaces without inside; penetrating pairs have distance 0
 * (so do those whose axis is deeper than the inflation). Boolean checks pad the capsules by margin and inflation and
 * use FCL's broad phase and collide(); where the inflations of objects differ, all but those of the largest one are
 * checked by FCL's distance(). The ground is checked by the scene: FCL 0.7 has no half-space distance and crashes.
 * Allocates.
 *
 * \code
 * vpFclChecker reference(scene);
 * vpSceneChecker checker(scene);
 * if (reference.inCollision(q, 0.) != checker.inCollision(q, 0.)) {
 *   std::cout << "touches by less than the errors of FCL" << std::endl;
 * }
 * \endcode
 */
class VISP_EXPORT vpFclChecker : public vpCollisionChecker
{
public:
  //! Copies the current objects of the scene; their poses are read at every call.
  explicit vpFclChecker(const vpCollisionScene &scene);
  ~vpFclChecker() VP_OVERRIDE;
  vpFclChecker(const vpFclChecker &) = delete;
  vpFclChecker &operator=(const vpFclChecker &) = delete;

  [[nodiscard]] int jointCount() const noexcept VP_OVERRIDE { return m_scene->arm().size(); }
  [[nodiscard]] bool inCollision(const vpJointVector &q, double margin) VP_OVERRIDE;
  [[nodiscard]] vpClearance clearance(const vpJointVector &q, double cutoff) VP_OVERRIDE;

private:
  [[nodiscard]] bool touchesGround(double margin) const;
  struct Bodies;
  const vpCollisionScene *m_scene;
  vpCollisionData m_data;
  std::unique_ptr<Bodies> m_bodies;
};

END_VISP_NAMESPACE
#endif
