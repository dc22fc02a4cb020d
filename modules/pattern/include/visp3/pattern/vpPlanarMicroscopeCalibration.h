/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlanarMicroscopeCalibration.h
 * \brief Estimates a vpMicroscopeCalibration from points of the product or of a grid.
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
 * \brief Parameters to estimate and given values of vpPlanarMicroscopeCalibration.
 */
struct VISP_EXPORT vpMicroscopeCalibrationSpec {
  double u0 = std::numeric_limits<double>::quiet_NaN(); //!< Principal point, px; NaN: the centre of the image.
  double v0 = std::numeric_limits<double>::quiet_NaN(); //!< Principal point, px; NaN: the centre of the image.
  double aspect = 1.;          //!< scaleY / scaleX, in [0.1, 10]; initial value when it is estimated.
  bool estimateAspect = false; //!< Estimate the aspect. Needs a product whose two pitches are known equally well.
  bool estimateTilt = true;    //!< Estimate the tilt of the plane, which in a small field resembles distortion.
  double maxTilt = 0.0873;     //!< A larger apparent tilt indicates a wrong pitch or lattice, rad, in [0, 0.5].
  bool estimateKappa1 = true;  //!< Estimate the distortion, where it is observable.
  bool estimatePrincipalPoint = false; //!< Estimate the centre of the distortion; only where kappa1 is observable.
  double minSignificance = 5.;         //!< Minimum kappa1, in standard deviations, in [0, 100].
  double minEffect = 0.02;             //!< Minimum effect of kappa1 in the image, px, >= 0: less than a tracker's bias.
  double maxCornerSigma = 0.5;         //!< Maximum effect of kappa1's sigma on the farthest corner, px, >= 0.
  bool sigmaFromResiduals = false;     //!< The points' deviations are only ratios; take the factor from the residuals.
  double falseAlarm = 0.01;            //!< vpFitTest::level: probability of a false misfit, in [1e-12, 0.5].

  //! \throw vpException (badValue) naming the field and its value.
  void check() const;
};

//! \ingroup group_pattern
//! \brief Status of kappa1.
enum class vpKappa1Status {
  Estimated,    //!< Estimated; its standard deviation is in the covariance.
  Unobservable, //!< Not determined by the points, or without effect: 0, and the covariance covers its uncertainty.
  NotAsked      //!< vpMicroscopeCalibrationSpec::estimateKappa1 was false: it is 0.
};

//! \ingroup group_pattern
//! \brief Placement of the product in one view.
struct VISP_EXPORT vpMicroscopePlacement {
  double rotation = 0.;       //!< Rotation, as vpMicroscopeCalibration::rotation, rad.
  double tx = 0.;             //!< Translation, as vpMicroscopeCalibration::tx, m.
  double ty = 0.;             //!< Translation, as vpMicroscopeCalibration::ty, m.
  Eigen::Matrix3d covariance; //!< Covariance of (rotation, tx, ty): rad, m, m.
};

//! \ingroup group_pattern
//! \brief Indices of the parameters in vpMicroscopeCalibrationResult::covariance.
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
 * \brief The calibration with its quality measures.
 */
struct VISP_EXPORT vpMicroscopeCalibrationResult {
  vpMicroscopeCalibration calibration;           //!< Calibration with the placement of the first view.
  std::vector<vpMicroscopePlacement> placements; //!< One per view.
  //! Covariance of #calibration, in the order of vpMicroscopeParameter and in its units; zero for given parameters.
  Eigen::Matrix<double, vpMicroscopeParameterCount, vpMicroscopeParameterCount> covariance;
  vpKappa1Status kappa1Status = vpKappa1Status::NotAsked; //!< Status of kappa1.
  double kappa1Sigma = 0.;       //!< Standard deviation of an estimate of kappa1 from these points, px^-2.
  double kappa1CornerSigma = 0.; //!< Effect of #kappa1Sigma on the farthest corner of the image, px.
  double kappa1Effect = 0.; //!< Effect of the estimate on the worst corner of the image, with all else refitted, px.
  bool principalPointEstimated = false; //!< u0 and v0 were estimated, not given.
  double residualRms = 0.;              //!< Root mean square reprojection error of the points, px.
  double varianceFactor = 0.; //!< Sum of squares over degrees of freedom: 1 when the points' deviations are correct.
  int degreesOfFreedom = 0;   //!< Two per point minus the number of parameters.
  int worstPoint = 0;         //!< Index of the point with the largest residual.
  double worstResidual = 0.;  //!< Residual of #worstPoint, standard deviations.
  //! Condition number of the common parameters (columns of equal length); above 1e3 they are correlated.
  double condition = 1.;
  int iterations = 0;     //!< Iterations of the refinement.
  bool converged = false; //!< The refinement converged.
  //! The tilt exceeds vpMicroscopeCalibrationSpec::maxTilt by more than noise explains.
  bool looksTiltedTooFar = false;
  vpFitTest fit; //!< Tests whether the calibration fits the points.
  //! Converged, the points fit, and distortion and tilt are neither missing nor implausible; see #message.
  bool reliable = false;
  std::string message; //!< Summary in a few sentences.

  //! Standard deviation of a parameter, in its unit.
  [[nodiscard]] double sigma(vpMicroscopeParameter parameter) const;
};

/*!
 * \class vpPlanarMicroscopeCalibration
 * \ingroup group_pattern
 * \brief Tsai's two steps for a plane that is parallel to the image or nearly so (thesis section 7.2.1, corrected).
 *
 * Step 1: the radial alignment u q = v p, with p and q of (7.10), is solved for the **homogeneous** 6-vector (r11, r12,
 * tx, r21, r22, ty); (7.8) divides by ty, which is near zero when the origin is. Where that is not unique (cells in two
 * rows lie on a conic) the initial value is an affine fit. Then (7.11) with the rows of u and of v **stacked**, not
 * added, gives M_o and kappa1: the deviations are 1.3 to 1.5 times smaller where cells fill the image, and up to 10
 * times where they lie along a line u + v = const.
 *
 * Step 2 minimises the residuals of (7.7), both rows, mapped back through the distortion to the measured pixels, over
 * common parameters (scale, aspect, tilt, kappa1, principal point) and a placement for each view. Weights are the
 * inverse variances of the points; the covariance is the inverse of the normal matrix.
 *
 * A tilt of two degrees, seen by points in a small part of the image, resembles distortion, and the residuals do not
 * reveal it. So the tilt (two terms of perspective, two of foreshortening) is part of the model. kappa1 is only
 * reported when it is significant, matters in the field of view *and* is known at the corner of the image: see
 * vpKappa1Status. Otherwise it is 0, and the covariance of the rest also includes the effect of a distortion of one
 * standard deviation (of the estimate itself when that is larger; at most 1 % at the corner).
 *
 * scaleX is the scale at the principal point, the mean over all directions of the product as seen.
 *
 * The points of one view are assumed independent; a flexible product whose sigmaPlane is large makes the same errors in
 * every frame, and the covariance of many frames is then too small.
 *
 * \code
 * vpPlanarMicroscopeCalibration microscope(640, 480);
 * vpPatternTracker tracker(640, 480);
 * for (int i = 0; i < 100; ++i) { // images of the product while it moves
 *   grabber.acquire(image);
 *   tracker.process(image);
 * }
 * microscope.addView(vpCalibrationPoints(tracker.frame(), {220e-6, 80e-6})); // pitches of columns and rows, m
 * const vpMicroscopeCalibrationResult result = microscope.compute();
 * std::cout << result.message << std::endl; // "The scale is 222222 +- 4 px/m (4.5 um a pixel). ..."
 * if (result.reliable) {
 *   result.calibration.saveXml("microscope.xml");
 * }
 * \endcode
 */
class VISP_EXPORT vpPlanarMicroscopeCalibration
{
public:
  /*!
   * \param width, height : Size of the images, px, each in [8, 65536].
   * \param spec : What to estimate and how.
   * \throw vpException (badValue) naming the value that is out of range.
   */
  vpPlanarMicroscopeCalibration(unsigned int width, unsigned int height,
                                const vpMicroscopeCalibrationSpec &spec = vpMicroscopeCalibrationSpec());

  /*!
   * Add the points of one image, at least 6 per view and not collinear.
   * \throw vpException (badValue) naming view, point, field and value in a sentence.
   */
  void addView(const std::vector<vpCalibrationPoint> &points);
  //! Number of views so far.
  [[nodiscard]] std::size_t viewCount() const { return m_views.size(); }

  //! \throw vpException (badValue) when there is no view, or when only some views are mirrored.
  [[nodiscard]] vpMicroscopeCalibrationResult compute() const;

private:
  unsigned int m_width;
  unsigned int m_height;
  vpMicroscopeCalibrationSpec m_spec;
  std::vector<std::vector<vpCalibrationPoint>> m_views;
};

//! \ingroup group_pattern
//! \brief Status as a word ("Estimated"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpKappa1Status status);

END_VISP_NAMESPACE
#endif
