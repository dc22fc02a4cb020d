/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpReferenceVision.h
 * \brief Vision of a servo loop from one reference image of a plane of unknown size.
 */
#ifndef vpReferenceVision_h
#define vpReferenceVision_h

#include <visp3/planar_target/vpPlaneTracker.h>
#include <visp3/servoing/vpReferencePose.h>

#include <memory>
#include <string>

BEGIN_VISP_NAMESPACE

//! \ingroup group_servoing
//! \brief Parameters of a vpReferenceVision.
struct VISP_EXPORT vpReferenceVisionSpec {
  vpReferencePoseSpec pose;     //!< Range of the distance, caution.
  vpPlanarTargetSpec keypoints; //!< Keypoints by which the plane is found at first.
  unsigned int points = 200;    //!< Maximum number of corners of the reference image that are followed, 20..512.
  double referenceNoise = 0.1;  //!< Standard deviation of a corner in the reference image, px, > 0, <= 10.

  //! \throw vpException (badValue) naming the field and its value.
  void validate() const;
};

/*!
 * \class vpReferenceVision
 * \ingroup group_servoing
 * \brief Vision that needs no model: an image taken at the goal shows where to go.
 *
 * The plane is found by keypoints (vpPlaneMatcher), then its corners are followed to a fraction of a pixel
 * (vpPlaneTracker), and vpReferencePose gives the camera's pose, the plane and, from the robot's motion, its distance.
 * Each sight has a goal: to be where the reference image was taken.
 * \code
 * vpReferenceVisionSpec spec;
 * spec.pose.nearest = 0.2; // m
 * spec.pose.farthest = 1.2;
 * vpVisualServo servo(vpServoController::create("ff-lookat"));
 * servo.setVision(std::make_unique<vpReferenceVision>(reference, camera, spec));
 * const vpServoSight &sight = servo.see(image, now()); // each image; see vpVisualServo
 * std::cout << servo.vision().message() << " " << sight.distance << " +- " << sight.distanceSigma << " m\n";
 * \endcode
 * The largest plane in the image is used; points outside of it are left out. The noise of the reference image decides the
 * error at the end: average several with vpReferenceTeacher.
 */
class VISP_EXPORT vpReferenceVision : public vpServoVision
{
public:
  /*!
   * \param reference : Image taken at the goal, of the same camera. \param camera : Its intrinsics; distortion is
   *   removed from the points.
   * \param spec : Parameters.
   * \throw vpException as vpPlaneTracker and vpReferencePose; (badValue) naming a field.
   */
  vpReferenceVision(const vpImage<unsigned char> &reference, const vpCameraParameters &camera,
                    const vpReferenceVisionSpec &spec = {});
  ~vpReferenceVision() VP_OVERRIDE;

  void see(const vpImage<unsigned char> &image, double time, const vpRigidTransform *fMc,
           vpServoSight &sight) VP_OVERRIDE;
  /*!
   * Goal relative to the plane: the object's frame is that of vpReferencePose::sight(), scaled as in the last image.
   * The goal of a sight, to be where the reference image was taken, replaces it.
   */
  [[nodiscard]] vpServoGoal goal(const vpHomogeneousMatrix &cdMo) const VP_OVERRIDE;
  [[nodiscard]] const std::string &message() const VP_OVERRIDE;
  //! Points of the last image.
  [[nodiscard]] const vpPlaneTrack &track() const;
  //! Pose, plane and distance from all images.
  [[nodiscard]] const vpReferencePoseResult &result() const;

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
