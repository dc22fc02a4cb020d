/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCertifiedMotion.h
 * \brief Certified collision check of a straight joint-space motion.
 */
#ifndef vpCertifiedMotion_h
#define vpCertifiedMotion_h

#include <visp3/avoidance/vpCollisionScene.h>
#include <visp3/avoidance/vpMotionResult.h>
#include <visp3/avoidance/vpReachBounds.h>

#include <memory>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief Parameters of vpCertifiedMotion.
 */
struct VISP_EXPORT vpCertifiedMotionSpec {
  double margin = 0.;       //!< Clearance that must be exceeded everywhere, m, >= 0.
  double resolution = 1e-5; //!< Intervals in which the arm moves less than this are not split further, m, > 0.
};

/*!
 * \class vpMotionScratch
 * \ingroup group_avoidance
 * \brief Scratch memory of vpCertifiedMotion::check(); one per thread. It grows for scenes with more pairs.
 */
class VISP_EXPORT vpMotionScratch
{
public:
  vpMotionScratch();
  ~vpMotionScratch();
  vpMotionScratch(vpMotionScratch &&other) noexcept;            //!< Moves.
  vpMotionScratch &operator=(vpMotionScratch &&other) noexcept; //!< Moves.

private:
  friend class vpCertifiedMotion;
  struct Memory;
  std::unique_ptr<Memory> m_memory;
};

/*!
 * \class vpCertifiedMotion
 * \ingroup group_avoidance
 * \brief Continuous collision check of a straight joint motion: Free is a proof for every point of
 * q(s) = from + s (to - from), not a statement about samples.
 *
 * An interval of half-width h about s_m is free for a pair if its clearance at s_m minus the margin exceeds the largest
 * motion of its parts within the interval: the smaller of h sum_j R_lj |dq_j| (vpReachBounds) and h |v| + h^2 / 2
 * sum_jk |dq_j| |dq_k| R_l,max(j,k), with v the velocity of the capsule's ends along the motion at s_m; the second term
 * bounds the acceleration. Convex obstacles are also tested along the normal of the nearest points, where only the
 * velocity towards the obstacle counts. For pairs of two capsules only the joints between them count. The capsules of a
 * link are evaluated where one capsule around them is not proven free. Unproven intervals are split into eight, for the
 * unproven pairs only; eight configurations are evaluated at once.
 *
 * Where capsules touch, or are still unproven at the resolution, and both parts have exact shapes
 * (vpCollisionSceneSpec::exact), these decide: a shape whose surface is at most t from the axes of its capsules moves
 * by at most h sum_j (R_lj + t) |dq_j|, and its distance (FCL) proves the part of the interval that it exceeds. Two
 * shapes, or a shape and an obstacle, may not be inside each other either. A Collision of exact shapes has the distance
 * 0.
 *
 * Immutable; may be shared by threads, each with its own vpMotionScratch.
 *
 * \code
 * const vpCertifiedMotion motions(scene, {0.01}); // margin, m
 * vpMotionScratch scratch;                        // one for each thread
 * const vpMotionResult result = motions.check(q, goal, scratch);
 * std::cout << result.message() << std::endl;
 * if (!result.isFree()) {
 *   std::cerr << scene.describe(result.pair) << " after " << 100. * result.s << " % of the way" << std::endl;
 * }
 * \endcode
 */
class VISP_EXPORT vpCertifiedMotion
{
public:
  /*!
   * \param scene : Must outlive this. Objects may be moved, added and removed, but not during check(); velocities are
   * ignored.
   * \param spec : Margin and resolution.
   * \throw vpException (badValue) naming margin or resolution and its value.
   */
  explicit vpCertifiedMotion(const vpCollisionScene &scene, const vpCertifiedMotionSpec &spec = {});

  //! Checks the motion, both ends included. Does not allocate unless the scratch has to grow, or exact shapes decide.
  [[nodiscard]] vpMotionResult check(const vpJointVector &from, const vpJointVector &to,
                                     vpMotionScratch &scratch) const;
  //! As check(), but does not say what is in the way: faster where motions collide.
  [[nodiscard]] bool isFree(const vpJointVector &from, const vpJointVector &to, vpMotionScratch &scratch) const;
  //! Margin and resolution.
  [[nodiscard]] const vpCertifiedMotionSpec &spec() const noexcept { return m_spec; }
  //! Reach bounds of the scene's arm.
  [[nodiscard]] const vpReachBounds &reach() const noexcept { return *m_reach; }

private:
  const vpMotionResult &prove(const vpJointVector &from, const vpJointVector &to, vpMotionScratch &scratch) const;

  const vpCollisionScene *m_scene;
  vpCertifiedMotionSpec m_spec;
  std::shared_ptr<const vpReachBounds> m_reach;
};

END_VISP_NAMESPACE
#endif
