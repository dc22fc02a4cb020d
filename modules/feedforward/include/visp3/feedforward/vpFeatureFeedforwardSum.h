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
#include <visp3/feedforward/vpServoLaw.h>
#include <visp3/feedforward/vpServoMeasurement.h>
#include <visp3/visual_features/vpBasicFeature.h>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpFeatureFeedforwardSum
 * \ingroup group_feedforward
 * \brief The rotation of the FF-PBVS law `ff-sum` as a feature of vpServo, 3 components, rad.
 *
 * Beside vpFeatureTranslation of type cdMc, and with vpServo::CURRENT, vpServo commands the velocity of the law:
 * vpFeedforwardTask sets this up. s = rotation (theta u - kappa c tanh(D / c)), D = th(p) - th(p*), th(x, y) = atan(r) / r
 * (-y, x, 0), where p and p* are the means of the image points visible now and in the goal (thesis (5.26)-(5.28),
 * corrected). Its desired value is zero.
 *
 * \note interaction() is the task matrix [0 I], not ds / dr: vpServo then commands w = -lambda s. No feature with its
 * true interaction matrix moves like this law. For that s' = -lambda s, and the motion has six eigenvalues -lambda at the
 * goal; with rotation and kappa 1 the law has four -lambda and two -2 lambda. So do not estimate the target's motion with
 * it, and do not expect s to decay exponentially while the camera translates.
 *
 * \code
 * vpFeatureTranslation t(vpFeatureTranslation::cdMc);
 * vpFeatureFeedforwardSum rotation;
 * vpServo task;
 * task.setServo(vpServo::EYEINHAND_CAMERA);
 * task.setInteractionMatrixType(vpServo::CURRENT);
 * task.setLambda(1.); // 1/s
 * task.addFeature(t);
 * task.addFeature(rotation);
 * // each cycle with a valid measurement:
 * const vpHomogeneousMatrix cdMc = goal.cdMo * measurement.cMo.inverse();
 * t.buildFrom(cdMc);
 * rotation.buildFrom(cdMc, measurement.points, goal.points); // throws where no point is visible
 * robot.setVelocity(vpRobot::CAMERA_FRAME, task.computeControlLaw());
 * \endcode
 */
class VISP_EXPORT vpFeatureFeedforwardSum : public vpBasicFeature
{
public:
  /*!
   * The feature at the goal: zero.
   * \param gains : Those of the law; rotation, kappa and saturation are used, lambda is vpServo::setLambda()'s.
   * \throw vpException (badValue) naming the gain and its value when one is out of its range.
   */
  explicit vpFeatureFeedforwardSum(const vpServoGains &gains = {});

  /*!
   * \param cdMc : Pose of the current camera in the desired camera frame, m.
   * \param points : Current image points of the object. \param goal : The same points in the desired camera.
   * \throw vpException (badValue) when their numbers differ, none is visible in both, one that is visible has no positive
   *   depth or a number that is not finite or above 1e6, or \e cdMc is not a valid pose.
   */
  void buildFrom(const vpHomogeneousMatrix &cdMc, const std::vector<vpServoPoint> &points,
                 const std::vector<vpServoPoint> &goal);

  //! Set the feature to zero, its desired value.
  void init() VP_OVERRIDE;
  //! Rows of the task matrix [0 I] chosen by \e select, n x 6.
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
  vpServoGains m_gains;
};

END_VISP_NAMESPACE
#endif
