/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCollisionChecker.h
 * \brief Collision queries of single configurations, by the fast path or another library.
 */
#ifndef vpCollisionChecker_h
#define vpCollisionChecker_h

#include <visp3/avoidance/vpCollisionScene.h>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpCollisionChecker
 * \ingroup group_avoidance
 * \brief Interface of collision queries for planners and discrete motions. One per thread; the scene must outlive it.
 */
class VISP_EXPORT vpCollisionChecker
{
public:
  virtual ~vpCollisionChecker() = default;
  //! Number of joints of the arm: size of a configuration.
  [[nodiscard]] virtual int jointCount() const noexcept = 0;
  //! True if a checked pair has a clearance <= \e margin (m) in configuration \e q.
  [[nodiscard]] virtual bool inCollision(const vpJointVector &q, double margin) = 0;
  //! The pair with the least clearance below \e cutoff (m), see vpCollisionScene::clearance().
  [[nodiscard]] virtual vpClearance clearance(const vpJointVector &q, double cutoff) = 0;
};

/*!
 * \class vpSceneChecker
 * \ingroup group_avoidance
 * \brief Collision checker using the fast path of vpCollisionScene. Does not allocate.
 *
 * \code
 * vpSceneChecker checker(scene);
 * if (checker.inCollision(q, 0.01)) { // margin, m; also where q does not fit the arm
 *   const vpClearance nearest = checker.clearance(q, 0.02);
 *   std::cerr << scene.describe(nearest) << ": " << nearest.distance << " m" << std::endl;
 * }
 * \endcode
 */
class VISP_EXPORT vpSceneChecker : public vpCollisionChecker
{
public:
  //! \param scene : Must outlive the checker.
  explicit vpSceneChecker(const vpCollisionScene &scene) : m_scene(&scene) {}
  [[nodiscard]] int jointCount() const noexcept VP_OVERRIDE { return m_scene->arm().size(); }
  [[nodiscard]] bool inCollision(const vpJointVector &q, double margin) VP_OVERRIDE;
  [[nodiscard]] vpClearance clearance(const vpJointVector &q, double cutoff) VP_OVERRIDE;

private:
  const vpCollisionScene *m_scene;
  vpCollisionData m_data;
};

END_VISP_NAMESPACE
#endif
