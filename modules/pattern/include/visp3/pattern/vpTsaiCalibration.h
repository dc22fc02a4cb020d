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
 * \brief What vpTsaiCalibration shall find and what it is told.
 */
struct VISP_EXPORT vpTsaiCalibrationOptions {
  double u0 = std::numeric_limits<double>::quiet_NaN(); //!< Principal point, px; NaN: the centre. Start when estimated.
  double v0 = std::numeric_limits<double>::quiet_NaN(); //!< Principal point, px; NaN: the centre. Start when estimated.
  double aspect = 1.;                                   //!< py / px, in [0.1, 10]; start when estimated.
  bool estimateAspect = true;         //!< Find py / px. Ignored for one view of a plane, which cannot tell.
  bool estimateKappa1 = true;         //!< Find the radial distortion.
  bool estimatePrincipalPoint = true; //!< Find u0 and v0. Ignored for one view of a plane, which cannot tell.
  bool sigmaFromResiduals = false;    //!< The points' deviations are only ratios; the residuals tell the common factor.
  double falseAlarm = 0.01;           //!< vpFitTest::level: right fits that may be called misfits, in [1e-12, 0.5].

  //! \throw vpException (badValue) naming the field and its value.
  void check() const;
};

//! \ingroup group_pattern
//! \brief Numbers of the parameters in vpTsaiCalibrationResult::covariance.
enum vpTsaiParameter : int { vpTsaiPx, vpTsaiPy, vpTsaiKappa1, vpTsaiU0, vpTsaiV0, vpTsaiParameterCount };

/*!
 * \ingroup group_pattern
 * \brief The camera with all that tells how good it is.
 */
struct VISP_EXPORT vpTsaiCalibrationResult {
  double px = 0.;                       //!< Focal length over the width of a pixel, px, > 0.
  double py = 0.;                       //!< Focal length over the height of a pixel, px, > 0.
  double u0 = 0.;                       //!< Principal point, px.
  double v0 = 0.;                       //!< Principal point, px.
  double kappa1 = 0.;                   //!< Of (4.5) with u and v in px (columns), px^-2. ViSP's kdu is kappa1 px^2.
  std::vector<vpHomogeneousMatrix> cMo; //!< Object in the camera, one for each view, m.
  //! Of (px, py, kappa1, u0, v0), in their units; zero where a parameter was given. With the aspect given, px and py
  //! have correlation 1.
  Eigen::Matrix<double, vpTsaiParameterCount, vpTsaiParameterCount> covariance;
  std::vector<double> viewRms; //!< The same as #residualRms of each view, px.
  double residualRms = 0.;     //!< Root mean square distance of the points from where they should be seen, px.
  double varianceFactor = 0.;  //!< Sum of squares over degrees of freedom: 1 when the points' deviations are right.
  int degreesOfFreedom = 0;    //!< Two per point less the parameters.
  double condition = 1.;       //!< Of the common parameters, columns scaled to equal length.
  int iterations = 0;          //!< Of the refinement.
  bool converged = false;      //!< The refinement came to its end.
  vpFitTest fit;               //!< Whether the camera fits the points, and which fit worst.
  //! It converged, the focal length is known to a tenth and the points fit; otherwise #message says what is wrong.
  bool reliable = false;
  std::string message; //!< All of it in a few sentences.

  //! Standard deviation of a parameter, in its unit.
  [[nodiscard]] double sigma(vpTsaiParameter parameter) const;
  //! For ViSP: px, py, u0, v0, kdu exact, kud = -kdu to first order.
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
 * The plane must be tilted: seen straight on, only f / tz can be told (use vpPlanarMicroscopeCalibration); the result
 * is
 * not `reliable` then and the sentence says so. Nor is it when the points do not fit (vpFitTest): outliers, a view whose
 * points have each other's names, wrong distances on the object. A wrong common scale of the object changes only the
 * poses and cannot be seen.
 */
class VISP_EXPORT vpTsaiCalibration
{
public:
  /*!
   * \param width, height : Size of the images, px, each in [8, 65536].
   * \param options : What to find and how.
   * \throw vpException (badValue) naming what is out of range.
   */
  vpTsaiCalibration(unsigned int width, unsigned int height,
                    const vpTsaiCalibrationOptions &options = vpTsaiCalibrationOptions());

  /*!
   * Points of one image; sigmaPlane is not used. At least 6 in a plane, or 8 that are in no plane; none may be behind
   * the
   * camera.
   * \throw vpException (badValue) in a sentence that names view, point, field and value.
   */
  void addView(const std::vector<vpCalibrationPoint> &points);
  //! Number of views so far.
  [[nodiscard]] std::size_t viewCount() const { return m_views.size(); }

  //! A misfit of up to 30 views is computed again without each of them, to name the one that does not belong.
  //! \throw vpException (badValue) when there is no view, (fatalError) when no camera can see a view's points so.
  [[nodiscard]] vpTsaiCalibrationResult compute() const;

private:
  [[nodiscard]] vpTsaiCalibrationResult solve(const std::vector<std::vector<vpCalibrationPoint>> &points) const;
  void findWorstView(vpTsaiCalibrationResult &result) const;

  unsigned int m_width;
  unsigned int m_height;
  vpTsaiCalibrationOptions m_options;
  std::vector<std::vector<vpCalibrationPoint>> m_views;
};

END_VISP_NAMESPACE
#endif
