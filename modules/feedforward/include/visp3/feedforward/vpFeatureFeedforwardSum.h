/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFeatureFeedforwardSum.h
 * \brief Visual feature for vpServo: rotation error of position-based servoing plus the object's bearing error.
 */
#ifndef vpFeatureFeedforwardSum_h
#define vpFeatureFeedforwardSum_h

#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/feedforward/vpServoMeasurement.h>
#include <visp3/visual_features/vpBasicFeature.h>

#include <Eigen/Core>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpFeatureFeedforwardSum
 * \ingroup group_feedforward
 * \brief Rotation error of the FF-PBVS law `ff-sum` as a feature of vpServo, 3 components, rad.
 *
 * s = theta u - kappa c tanh(D / c), D = th(p) - th(p*), th(x, y) = atan(r) / r (-y, x, 0), for one image point p
 * (thesis (5.26)-(5.28), corrected). Its desired value is zero. The interaction matrix is exact, L = [-kappa S J Lv,
 * L_theta_u - kappa S J Lw], so vpServo also compensates the image motion caused by the translation, which the law
 * `ff-sum` does not: the two share the error only and move differently.
 */
class VISP_EXPORT vpFeatureFeedforwardSum : public vpBasicFeature
{
public:
  /*!
   * The feature at the goal: zero.
   * \param kappa : Weight of the image term, >= 0. \param saturation : Its bound c, rad, > 0.
   * \throw vpException (badValue) naming the argument and its value.
   */
  explicit vpFeatureFeedforwardSum(double kappa = 1., double saturation = 0.5);

  /*!
   * \param cdMc : Pose of the current camera in the desired camera frame, m.
   * \param point : Current image point of the object. \param goal : Image point in the desired camera.
   * \throw vpException (badValue) when the depth of \e point is not positive, a number is not finite or above 1e6, or
   *   \e cdMc is not a valid pose.
   */
  void buildFrom(const vpHomogeneousMatrix &cdMc, const vpServoPoint &point, const vpServoPoint &goal);

  //! Set the feature to zero, its desired value.
  void init() VP_OVERRIDE;
  //! Rows of the interaction matrix chosen by \e select, n x 6.
  vpMatrix interaction(unsigned int select = FEATURE_ALL) VP_OVERRIDE;
  //! Print the chosen components to the standard output.
  void print(unsigned int select = FEATURE_ALL) const VP_OVERRIDE;
  //! A copy on the heap, owned by the caller.
  vpFeatureFeedforwardSum *duplicate() const VP_OVERRIDE;
  //! Draws nothing: a rotation has no image position.
  void display(const vpCameraParameters &, const vpImage<unsigned char> &, const vpColor &,
               unsigned int) const VP_OVERRIDE
  {}
  //! Draws nothing.
  void display(const vpCameraParameters &, const vpImage<vpRGBa> &, const vpColor &, unsigned int) const VP_OVERRIDE {}

private:
  double m_kappa;
  double m_saturation;
  Eigen::Matrix<double, 3, 6> m_interaction;
};

END_VISP_NAMESPACE
#endif
