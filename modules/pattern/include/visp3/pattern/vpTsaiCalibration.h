/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTsaiCalibration.h
 * \brief Tsai's camera calibration \cite Tsai87 with one radial distortion (thesis section 4.2.1).
 */
#ifndef vpTsaiCalibration_h
#define vpTsaiCalibration_h

#include <visp3/pattern/vpCalibrationPoint.h>
#include <visp3/pattern/vpFitTest.h>

#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpHomogeneousMatrix.h>

#include <Eigen/Core>

#include <limits>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_pattern
 * \brief Parameters to estimate and given values of vpTsaiCalibration.
 */
struct VISP_EXPORT vpTsaiCalibrationSpec {
  double u0 = std::numeric_limits<double>::quiet_NaN(); //!< Principal point, px; NaN: the centre. Initial if estimated.
  double v0 = std::numeric_limits<double>::quiet_NaN(); //!< Principal point, px; NaN: the centre. Initial if estimated.
  double aspect = 1.;                                   //!< py / px, in [0.1, 10]; initial value when estimated.
  bool estimateAspect = true;         //!< Estimate py / px. Ignored for one view of a plane (unobservable).
  bool estimateKappa1 = true;         //!< Estimate the radial distortion.
  bool estimatePrincipalPoint = true; //!< Estimate u0 and v0. Ignored for one view of a plane (unobservable).
  bool sigmaFromResiduals = false;    //!< The points' deviations are only ratios; take the factor from the residuals.
  double falseAlarm = 0.01;           //!< vpFitTest::level: probability of a false misfit, in [1e-12, 0.5].

  //! \throw vpException (badValue) naming the field and its value.
  void check() const;
};

//! \ingroup group_pattern
//! \brief Indices of the parameters in vpTsaiCalibrationResult::covariance.
enum vpTsaiParameter : int { vpTsaiPx, vpTsaiPy, vpTsaiKappa1, vpTsaiU0, vpTsaiV0, vpTsaiParameterCount };

/*!
 * \ingroup group_pattern
 * \brief The camera with its quality measures.
 */
struct VISP_EXPORT vpTsaiCalibrationResult {
  double px = 0.;                       //!< Focal length over the width of a pixel, px, > 0.
  double py = 0.;                       //!< Focal length over the height of a pixel, px, > 0.
  double u0 = 0.;                       //!< Principal point, px.
  double v0 = 0.;                       //!< Principal point, px.
  double kappa1 = 0.;                   //!< (4.5) with u and v in px (columns), px^-2. ViSP's kdu is kappa1 px^2.
  std::vector<vpHomogeneousMatrix> cMo; //!< Pose of the object in the camera, one per view, m.
  //! Covariance of (px, py, kappa1, u0, v0), in their units; zero for given parameters. With the aspect given, px and
  //! py have correlation 1.
  Eigen::Matrix<double, vpTsaiParameterCount, vpTsaiParameterCount> covariance;
  std::vector<double> viewRms; //!< Root mean square reprojection error of each view, px.
  double residualRms = 0.;     //!< Root mean square reprojection error of all points, px.
  double varianceFactor = 0.;  //!< Sum of squares over degrees of freedom: 1 when the points' deviations are correct.
  int degreesOfFreedom = 0;    //!< Two per point minus the number of parameters.
  double condition = 1.;       //!< Condition number of the common parameters (columns of equal length).
  int iterations = 0;          //!< Iterations of the refinement.
  bool converged = false;      //!< The refinement converged.
  vpFitTest fit;               //!< Tests whether the camera fits the points.
  //! Converged, the focal length is known to a tenth and the points fit; otherwise #message gives the reason.
  bool reliable = false;
  std::string message; //!< Summary in a few sentences.

  //! Standard deviation of a parameter, in its unit.
  [[nodiscard]] double sigma(vpTsaiParameter parameter) const;
  //! ViSP camera: px, py, u0, v0, kdu exact, kud = -kdu to first order.
  [[nodiscard]] vpCameraParameters toCamera() const;
};

/*!
 * \class vpTsaiCalibration
 * \ingroup group_pattern
 * \brief Pinhole camera with radial distortion from points of a solid body, of a plane, or of a plane in several views.
 *
 * Step 1, for each view: the radial alignment (4.9), homogeneous (it is singular as ty goes to zero, as printed), gives
 * the rotation, tx and ty; (4.6) and (4.7) without distortion, stacked and not added as in (4.10), give f and tz.
 * Step 2 minimises the distance in the image over f, aspect, kappa1, principal point and all poses, weighted.
 *
 * The plane must be tilted: viewed perpendicularly, only f / tz is observable (use vpPlanarMicroscopeCalibration); the
 * result is then not `reliable` and the message says so. Nor is it when the points do not fit (vpFitTest): outliers, a
 * view with permuted points, wrong distances on the object. A wrong common scale of the object changes only the poses
 * and cannot be detected.
 *
 * \code
 * vpTsaiCalibrationSpec spec;
 * spec.sigmaFromResiduals = true; // how well dots are measured is not known
 * vpTsaiCalibration calibration(640, 480, spec);
 * for (int view = 0; view < 6; ++view) { // of a grid of dots 10 mm apart, in each image tilted another way
 *   grabber.acquire(image);
 *   calibration.addView(vpCalibrationPoints(image, {0.01, 0.01}));
 * }
 * const vpTsaiCalibrationResult result = calibration.compute();
 * std::cout << result.message << std::endl;
 * if (result.reliable) {
 *   std::cout << result.px << " +- " << result.sigma(vpTsaiPx) << " px\n" << result.toCamera() << std::endl;
 * }
 * \endcode
 */
class VISP_EXPORT vpTsaiCalibration
{
public:
  /*!
   * \param width, height : Size of the images, px, each in [8, 65536].
   * \param spec : What to estimate and how.
   * \throw vpException (badValue) naming the value that is out of range.
   */
  vpTsaiCalibration(unsigned int width, unsigned int height,
                    const vpTsaiCalibrationSpec &spec = vpTsaiCalibrationSpec());

  /*!
   * Add the points of one image; sigmaPlane is not used. At least 6 in a plane, or 8 not in a plane; none may be behind
   * the camera.
   * \throw vpException (badValue) naming view, point, field and value in a sentence.
   */
  void addView(const std::vector<vpCalibrationPoint> &points);
  //! Number of views so far.
  [[nodiscard]] std::size_t viewCount() const { return m_views.size(); }

  //! For a misfit of up to 30 views the calibration is repeated without each of them, to find the wrong one.
  //! \throw vpException (badValue) when there is no view, (fatalError) when no camera can see a view's points as given.
  [[nodiscard]] vpTsaiCalibrationResult compute() const;

private:
  [[nodiscard]] vpTsaiCalibrationResult solve(const std::vector<std::vector<vpCalibrationPoint>> &points) const;
  void findWorstView(vpTsaiCalibrationResult &result) const;

  unsigned int m_width;
  vpTsaiCalibrationSpec m_spec;
  std::vector<std::vector<vpCalibrationPoint>> m_views;
};

END_VISP_NAMESPACE
#endif
