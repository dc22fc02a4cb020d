/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlanarMicroscopeCalibration.h
 * \brief Finds a vpMicroscopeCalibration from points of the product or of a grid.
 */
#ifndef vpPlanarMicroscopeCalibration_h
#define vpPlanarMicroscopeCalibration_h

#include <visp3/pattern/vpCalibrationPoint.h>
#include <visp3/pattern/vpFitTest.h>
#include <visp3/pattern/vpMicroscopeCalibration.h>

#include <limits>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_pattern
 * \brief What vpPlanarMicroscopeCalibration shall find and what it is told.
 */
struct VISP_EXPORT vpMicroscopeCalibrationOptions {
  double u0 = std::numeric_limits<double>::quiet_NaN(); //!< Principal point, px; NaN: the centre of the image.
  double v0 = std::numeric_limits<double>::quiet_NaN(); //!< Principal point, px; NaN: the centre of the image.
  double aspect = 1.;          //!< scaleY / scaleX, in [0.1, 10]; start value when it is estimated.
  bool estimateAspect = false; //!< Find the aspect too. Needs a product whose two pitches are known equally well.
  bool estimateTilt = true;    //!< Find the tilt of the plane, which a small field otherwise takes for distortion.
  double maxTilt = 0.0873;     //!< A plane that looks tilted by more is a wrong pitch or lattice, rad, in [0, 0.5].
  bool estimateKappa1 = true;  //!< Find the distortion, where it can be observed.
  bool estimatePrincipalPoint = false; //!< Find the centre of the distortion; only where kappa1 can be observed.
  double minSignificance = 5.;         //!< kappa1 must be this many standard deviations from zero, in [0, 100].
  double minEffect = 0.02;     //!< And change places in the image by this much, px, >= 0: less than a tracker's bias.
  double maxCornerSigma = 0.5; //!< And its deviation may move the farthest corner by this much at most, px, >= 0.
  bool sigmaFromResiduals = false; //!< The points' deviations are only ratios; the residuals tell the common factor.
  double falseAlarm = 0.01;        //!< vpFitTest::level: right fits that may be called misfits, in [1e-12, 0.5].

  //! \throw vpException (badValue) naming the field and its value.
  void check() const;
};

//! \ingroup group_pattern
//! \brief What became of kappa1.
enum class vpKappa1Status {
  Estimated,    //!< Found; its standard deviation is in the covariance.
  Unobservable, //!< The points cannot tell it, or it changes nothing: it is 0, and the covariance covers what is unseen.
  NotAsked      //!< vpMicroscopeCalibrationOptions::estimateKappa1 was false: it is 0.
};

//! \ingroup group_pattern
//! \brief Where the product lay in one view.
struct VISP_EXPORT vpMicroscopePlacement {
  double rotation = 0.;       //!< As vpMicroscopeCalibration::rotation, rad.
  double tx = 0.;             //!< As vpMicroscopeCalibration::tx, m.
  double ty = 0.;             //!< As vpMicroscopeCalibration::ty, m.
  Eigen::Matrix3d covariance; //!< Of (rotation, tx, ty): rad, m, m.
};

//! \ingroup group_pattern
//! \brief Numbers of the parameters in vpMicroscopeCalibrationResult::covariance.
enum vpMicroscopeParameter : int {
  vpMicroscopeScaleX,
  vpMicroscopeScaleY,
  vpMicroscopeKappa1,
  vpMicroscopeU0,
  vpMicroscopeV0,
  vpMicroscopeRotation,
  vpMicroscopeTx,
  vpMicroscopeTy,
  vpMicroscopeTiltX,
  vpMicroscopeTiltY,
  vpMicroscopeStretch,
  vpMicroscopeShear,
  vpMicroscopeParameterCount
};

/*!
 * \ingroup group_pattern
 * \brief The calibration with all that tells how good it is.
 */
struct VISP_EXPORT vpMicroscopeCalibrationResult {
  vpMicroscopeCalibration calibration;           //!< With the placement of the first view.
  std::vector<vpMicroscopePlacement> placements; //!< One for each view.
  //! Of calibration, in the order of vpMicroscopeParameter and in its units; zero where a parameter was given.
  Eigen::Matrix<double, vpMicroscopeParameterCount, vpMicroscopeParameterCount> covariance;
  vpKappa1Status kappa1Status = vpKappa1Status::NotAsked; //!< What became of kappa1.
  double kappa1Sigma = 0.;       //!< Standard deviation that an estimate of kappa1 has with these points, px^-2.
  double kappa1CornerSigma = 0.; //!< What that moves the farthest corner of the image by, px.
  double kappa1Effect = 0.; //!< How far the estimate moves the worst corner of the image, all else adapted to it, px.
  bool principalPointEstimated = false; //!< u0 and v0 were found and not given.
  double residualRms = 0.;              //!< Root mean square distance of the points from where they should be seen, px.
  double varianceFactor = 0.; //!< Sum of squares over degrees of freedom: 1 when the points' deviations are right.
  int degreesOfFreedom = 0;   //!< Two per point less the parameters.
  int worstPoint = 0;         //!< That point.
  double worstResidual = 0.;  //!< Its residual, standard deviations.
  double condition = 1.;  //!< Of the common parameters, columns scaled to equal length; above 1e3 they hang together.
  int iterations = 0;     //!< Of the refinement.
  bool converged = false; //!< The refinement came to its end.
  bool looksTiltedTooFar = false; //!< More than vpMicroscopeCalibrationOptions::maxTilt, and noise does not explain it.
  vpFitTest fit;                  //!< Whether the calibration fits the points, and which fit worst.
  //! It converged, the points fit, and neither distortion nor tilt is left out or beyond belief; see #message.
  bool reliable = false;
  std::string message; //!< All of it in a few sentences.

  //! Standard deviation of a parameter, in its unit.
  [[nodiscard]] double sigma(vpMicroscopeParameter parameter) const;
};

/*!
 * \class vpPlanarMicroscopeCalibration
 * \ingroup group_pattern
 * \brief Tsai's two steps for a plane that is parallel to the image or nearly so (thesis section 7.2.1, corrected).
 *
 * Step 1: the radial alignment u q = v p, with p and q of (7.10), is solved for the **homogeneous** 6-vector
 * (r11, r12, tx, r21, r22, ty); (7.8) divides by ty, which is near zero when the origin is. Where that is not unique
 * (cells in two rows lie on a conic) the start is an affine fit. Then (7.11) with the rows of u and of v **stacked**,
 * not
 * added, gives M_o and kappa1: the deviations are 1.3 to 1.5 times smaller where cells fill the image, and up to 10
 * times
 * where they lie along a line u + v = const.
 *
 * Step 2 minimises the residuals of (7.7), both rows, taken back through the distortion to where the noise is, in
 * pixels, over common parameters (scale, aspect, tilt, kappa1, principal point) and a placement for each view. Weights are
 * the
 * inverse variances of the points; the covariance is the inverse of the normal matrix.
 *
 * A tilt of two degrees, seen by points in a small part of the image, looks like distortion, and the residuals do not
 * tell. So the tilt (two terms of perspective, two of foreshortening) is part of the model. kappa1 is only reported when
 * it is significant, matters in the field of view *and* is known at the corner of the image: see vpKappa1Status. Where it
 * is not, it is 0, and the covariance of the rest holds as well what a distortion of one standard deviation (of as much
 * as the estimate says when that is more; 1 % at the corner at most) would change.
 *
 * scaleX is the scale at the principal point, the mean over all directions of the product as it is seen.
 *
 * The points of one view are independent; a flexible product whose sigmaPlane is large makes the same errors in every
 * frame, and the covariance of many frames then is too small.
 *
 * \code
 * vpPlanarMicroscopeCalibration microscope(640, 480);
 * microscope.addView(vpCalibrationPoints(tracker.frame(), {220e-6, 80e-6}));
 * const vpMicroscopeCalibrationResult result = microscope.compute();
 * std::cout << result.message << std::endl; // "The scale is 222222 +- 4 px/m (4.5 um a pixel). ..."
 * \endcode
 */
class VISP_EXPORT vpPlanarMicroscopeCalibration
{
public:
  /*!
   * \param width, height : Size of the images, px, each in [8, 65536].
   * \param options : What to find and how.
   * \throw vpException (badValue) naming what is out of range.
   */
  vpPlanarMicroscopeCalibration(unsigned int width, unsigned int height,
                                const vpMicroscopeCalibrationOptions &options = vpMicroscopeCalibrationOptions());

  /*!
   * Points of one image. They must not lie on a line, and there must be at least 6 in the view.
   * \throw vpException (badValue) in a sentence that names view, point, field and value.
   */
  void addView(const std::vector<vpCalibrationPoint> &points);
  //! Number of views so far.
  [[nodiscard]] std::size_t viewCount() const { return m_views.size(); }

  //! \throw vpException (badValue) when there is no view, or when views are mirrored and others are not.
  [[nodiscard]] vpMicroscopeCalibrationResult compute() const;

private:
  unsigned int m_width;
  unsigned int m_height;
  vpMicroscopeCalibrationOptions m_options;
  std::vector<std::vector<vpCalibrationPoint>> m_views;
};

//! \ingroup group_pattern
//! \brief The status as a word ("Estimated"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *toString(vpKappa1Status status);

END_VISP_NAMESPACE
#endif
