/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFeatureLookAt.h
 * \brief Visual feature for vpServo: rotation error relative to the orientation that looks at the object.
 */
#ifndef vpFeatureLookAt_h
#define vpFeatureLookAt_h

#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/feedforward/vpServoLaw.h>
#include <visp3/visual_features/vpBasicFeature.h>

#include <Eigen/Core>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpFeatureLookAt
 * \ingroup group_feedforward
 * \brief The rotation of the FF-PBVS law `ff-lookat` as a feature of vpServo, 3 components, rad.
 *
 * With (R, t) of cdMc and O* the object's origin in the desired camera frame, R_la is the rotation of smallest angle
 * from O* to O* - t, the orientation in which the camera sees the object at its desired image position. With e = theta
 * u(R_la^T R), s = rho e; its desired value is zero. rho = 2 vpServoGains::rotation is the law's gain on the rotation
 * relative to that on the translation, which vpServo has not.
 *
 * Beside vpFeatureTranslation of type cdMc, and with vpServo::CURRENT, vpServo commands the velocity of the law;
 * vpFeedforwardTask sets this up.
 *
 * \note interaction() is the task matrix: the exact interaction matrix of e, L = J_r^-1(e) [R^T W R, I], with W the rate
 * of R_la per rate of the direction O* - t. That of s is rho L, with which vpServo would divide by rho again. Rounding
 * grows towards the object's origin: at 1 mm the velocity differs from the law's by up to 1e-6 of the angular velocity.
 *
 * \code
 * vpFeatureTranslation t(vpFeatureTranslation::cdMc);
 * vpFeatureLookAt gaze;
 * vpServo task;
 * task.setServo(vpServo::EYEINHAND_CAMERA);
 * task.setInteractionMatrixType(vpServo::CURRENT);
 * task.setLambda(1.); // 1/s
 * task.addFeature(t);
 * task.addFeature(gaze);
 * // each cycle with a valid measurement:
 * const vpHomogeneousMatrix cdMc = goal.cdMo * measurement.cMo.inverse();
 * t.buildFrom(cdMc);
 * gaze.buildFrom(cdMc, goal.cdMo);
 * robot.setVelocity(vpRobot::CAMERA_FRAME, task.computeControlLaw());
 * \endcode
 */
class VISP_EXPORT vpFeatureLookAt : public vpBasicFeature
{
public:
  /*!
   * The feature at the goal: zero.
   * \param gains : Those of the law; rotation is used, lambda is vpServo::setLambda()'s.
   * \throw vpException (badValue) naming the gain and its value when one is out of its range.
   */
  explicit vpFeatureLookAt(const vpServoGains &gains = {});

  /*!
   * \param cdMc : Pose of the current camera in the desired camera frame, m.
   * \param cdMo : Pose of the object in the desired camera frame, m.
   * \throw vpException (badValue) when the camera is at the object's origin or opposite to it, or a pose is invalid.
   */
  void buildFrom(const vpHomogeneousMatrix &cdMc, const vpHomogeneousMatrix &cdMo);

  //! Set the feature to zero, its desired value.
  void init() VP_OVERRIDE;
  //! Rows of the task matrix L chosen by \e select, n x 6.
  vpMatrix interaction(unsigned int select = FEATURE_ALL) VP_OVERRIDE;
  //! Print the chosen components to the standard output.
  void print(unsigned int select = FEATURE_ALL) const VP_OVERRIDE;
  //! A copy on the heap, owned by the caller.
  vpFeatureLookAt *duplicate() const VP_OVERRIDE;
  //! Draws nothing: a rotation has no image position.
  void display(const vpCameraParameters &, const vpImage<unsigned char> &, const vpColor &,
               unsigned int) const VP_OVERRIDE
  {}
  //! Draws nothing.
  void display(const vpCameraParameters &, const vpImage<vpRGBa> &, const vpColor &, unsigned int) const VP_OVERRIDE {}

private:
  double m_factor;
  Eigen::Matrix<double, 3, 6> m_interaction;
};

END_VISP_NAMESPACE
#endif
