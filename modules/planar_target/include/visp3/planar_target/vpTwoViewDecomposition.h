/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTwoViewDecomposition.h
 * \brief Camera motion between two views of a plane of unknown size: selects the true decomposition of the homography.
 */
#ifndef vpTwoViewDecomposition_h
#define vpTwoViewDecomposition_h

#include <visp3/core/vpColVector.h>
#include <visp3/core/vpRotationMatrix.h>
#include <visp3/core/vpTranslationVector.h>
#include <visp3/direct_core/vpDirectCompat.h>
#include <visp3/vision/vpHomography.h>

#include <string>
#include <utility>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_planar_target
//! \brief Result of a decomposition. Only Unique has a motion.
enum class vpTwoViewStatus {
  Unique,       //!< One motion, see vpTwoViewResult::best.
  Ambiguous,    //!< Two motions fit and cannot be distinguished yet: keep moving, or set a normal prior.
  PureRotation, //!< sigma1 = sigma3: rotation only (or too little motion); plane and translation are unobservable.
  Invalid //!< The homography is not finite, singular or mirrored, a point is not finite, or no motion sees all points
          //!< in front of both cameras.
};

//! \ingroup group_planar_target
//! \brief Status as a word ("Unique"), static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpTwoViewStatus status);

//! \ingroup group_planar_target
//! \brief One physically possible motion.
struct VISP_EXPORT vpTwoViewMotion {
  vpRotationMatrix c2Rc1;               //!< Orientation of the reference camera in the current one.
  vpTranslationVector t = {0., 0., 0.}; //!< c2tc1 / d, d the distance of the plane from the reference camera; no unit.
  vpColVector normal;                   //!< Unit normal of the plane in the reference camera, pointing away from it.
};

//! \ingroup group_planar_target
//! \brief Result of one frame.
struct VISP_EXPORT vpTwoViewResult {
  vpTwoViewStatus status = vpTwoViewStatus::Invalid; //!< Status of the frame.
  std::string message;                               //!< One sentence for users.
  vpTwoViewMotion best;                              //!< Motion; valid when \e status is Unique.
  std::vector<vpTwoViewMotion> candidates;           //!< Motions with positive depth: none, one or two.
};

//! \ingroup group_planar_target
//! \brief Settings of vpTwoViewDecomposition.
struct VISP_EXPORT vpTwoViewSpec {
  double minTranslation = 0.02;    //!< Shorter motions, as a fraction of the plane's distance, are PureRotation, > 0.
  double normalTolerance = 0.0873; //!< Angle up to which normals are equal, rad, 0..0.5 (5 deg). Raise with the noise.
  //! \throw vpException (badValue) naming the field and its value.
  void validate() const;
};

/*!
 * \class vpTwoViewDecomposition
 * \ingroup group_planar_target
 * \brief Camera motion from the Euclidean homography x2 ~ H x1, H = R + t n^T / d, in three steps (thesis 4.3.2).
 *
 * -# **Four.** The singular values of H, scaled so that sigma2 = 1, give four triples (R, t/d, n): two planes, each
 *    with the sign of (t, n) undetermined, by ViSP's vpHomography::computeDisplacement.
 * -# **Two.** All points were seen, so they lie in front of the reference camera: n . x1 > 0 for every point. One sign
 *    of each pair remains, for one or both planes.
 * -# **One.** Two planes explain one pair of views equally well. Either the normal is roughly known (setNormalPrior()),
 *    or a further frame decides: the true normal, in the reference frame, is the same for every motion, the false one
 *    changes with it. Hypotheses that no candidate of a new frame confirms are dropped; while more than one is left the
 *    status is Ambiguous. A decided normal then serves as the prior.
 *
 * Degenerate: with sigma1 - sigma3 = |t| / d below vpTwoViewSpec::minTranslation the camera has only rotated; the
 * decomposition would return noise, so the status is PureRotation. With t parallel to n both planes coincide, and the
 * motion is immediately Unique.
 *
 * The homography comes from vpHomography or OpenCV, in normalised coordinates, not pixels.
 *
 * \code
 * vpPlaneMatcher matcher(reference);
 * vpTwoViewDecomposition decomposition;
 * const vpPlaneMatch &match = matcher.match(image); // each frame, while the camera moves
 * if (match.found()) {
 *   const vpTwoViewResult &motion = decomposition.process(match.euclidean(camera), match.referencePoints(camera));
 *   std::cout << motion.message << std::endl;
 *   if (motion.status == vpTwoViewStatus::Unique) {
 *     std::cout << motion.best.c2Rc1 << "\n" << motion.best.t.t() << std::endl; // in units of the plane's distance
 *   }
 * }
 * \endcode
 */
class VISP_EXPORT vpTwoViewDecomposition
{
public:
  //! \throw vpException (badValue) naming the setting that is out of its range.
  explicit vpTwoViewDecomposition(const vpTwoViewSpec &spec = {});

  /*!
   * Set the approximate plane normal, in the reference camera frame: decides between the two planes at once.
   * \throw vpException (badValue) if \e normal does not have 3 finite components or is zero.
   */
  void setNormalPrior(const vpColVector &normal);
  //! Forget the prior and all hypotheses, for a new reference view.
  void reset();

  /*!
   * Process one frame.
   * \param c2Hc1 : Homography from the reference view to the current one, normalised coordinates, any scale.
   * \param points : Points of the plane visible in both views, (x, y) in the reference view, normalised; at least one.
   */
  const vpTwoViewResult &process(const vpHomography &c2Hc1, const std::vector<std::pair<double, double>> &points);
  //! The last result.
  [[nodiscard]] const vpTwoViewResult &result() const { return m_result; }

private:
  void conclude(vpTwoViewStatus status, const std::string &message);
  void choose();
  void chooseByPrior();
  void chooseByHistory();

  vpTwoViewSpec m_spec;
  vpTwoViewResult m_result;
  std::vector<vpColVector> m_hypotheses; // normals confirmed by every frame so far; one: decided, or the prior
  bool m_hasPrior = false;
};

END_VISP_NAMESPACE
#endif
