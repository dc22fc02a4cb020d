/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoVision.h
 * \brief Vision of a servo loop: image in, measurement out.
 */
#ifndef vpServoVision_h
#define vpServoVision_h

#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpImage.h>
#include <visp3/feedforward/vpServoMeasurement.h>
#include <visp3/manipulator/vpArmTypes.h>
#include <visp3/planar_target/vpPlanarTarget.h>
#include <visp3/servoing/vpServoTarget.h>

#include <functional>
#include <memory>
#include <string>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_servoing
 * \brief Result of one image. Reuse one object: see vpServoMeasurement.
 */
struct VISP_EXPORT vpServoSight {
  vpServoMeasurement measurement; //!< Invalid when the target was not found; its time is that of capture.
  vpServoGoal goal;               //!< New goal of the law, if #hasGoal; with as many points as the measurement.
  bool hasGoal = false;           //!< Set by vision whose goal depends on what it has learnt: one reference image.
  double distance = 0.;      //!< Estimated distance of the reference plane at the goal, m; 0 where the size is known.
  double distanceSigma = 0.; //!< Standard deviation of #distance, m.
  double speedFactor = 1.;   //!< Factor on the limits of speed, (0, 1]; below 1 while the pose is ambiguous.
};

/*!
 * \class vpServoVision
 * \ingroup group_servoing
 * \brief Finds the target of a servo loop in images. One object per camera; used by one thread at a time.
 *
 * \code
 * const std::unique_ptr<vpServoVision> vision = vpServoVision::tag("36h11", 3, 0.05, camera); // number, side in m
 * vpServoSight sight;
 * vision->see(image, now(), nullptr, sight); // each frame
 * if (sight.measurement.valid) {
 *   std::cout << sight.measurement.cMo << "\n+- " << sight.measurement.covariance.positionDeviation() << " m\n";
 * }
 * else {
 *   std::cerr << vision->message() << std::endl;
 * }
 * \endcode
 */
class VISP_EXPORT vpServoVision
{
public:
  virtual ~vpServoVision() = default;
  vpServoVision(const vpServoVision &) = delete;
  vpServoVision &operator=(const vpServoVision &) = delete;

  /*!
   * Processes one image.
   * \param image : The image. \param time : Time of its capture, s, on the clock of the control loop.
   * \param fMc : Pose of the camera at that time in the frame in which the object is at rest: the robot's base, or the
   *   end effector for a fixed camera that looks at what the arm holds. Null where it is not known.
   * \param sight : All of its fields are set.
   * \throw vpException where the image cannot be processed at all; no target in it is no error.
   */
  virtual void see(const vpImage<unsigned char> &image, double time, const vpRigidTransform *fMc,
                   vpServoSight &sight) = 0;
  //! Goal of a law with the target's points. \param cdMo : Pose of the object in the desired camera frame, m.
  [[nodiscard]] virtual vpServoGoal goal(const vpHomogeneousMatrix &cdMo) const = 0;
  //! One sentence about the last image.
  [[nodiscard]] virtual const std::string &message() const = 0;

  /*!
   * Vision by vpPlanarTarget: a textured plane. The law sees the corners of the photograph, z = 0, origin in its
   * centre.
   * \param photo : Fronto-parallel image of the target. \param width, height : Its size, m, > 0.
   * \param camera : Intrinsics; distortion is removed. \param spec : Settings.
   * \throw vpException as vpPlanarTarget.
   */
  [[nodiscard]] static std::unique_ptr<vpServoVision> photograph(const vpImage<unsigned char> &photo, double width,
                                                                 double height, const vpCameraParameters &camera,
                                                                 const vpPlanarTargetSpec &spec = {});

  /*!
   * Vision by an AprilTag (vpDetectorAprilTag); frame and points as photograph(), for the black square. The covariance
   * of the pose follows from the noise of the corners. Where two poses of the square fit, the one nearer to the last is
   * taken and vpServoSight::speedFactor is 0.3.
   * \param family : "36h11", "25h9", "16h5", "Circle21h7" or "Standard41h12". \param id : Number of the tag.
   * \param size : Side of the black square, m, > 0. \param camera : Intrinsics; distortion is removed.
   * \param cornerSigma : Standard deviation of a corner's coordinate, px, > 0.
   * \throw vpException (badValue) naming what is unknown or out of range; (notImplementedError) with a ViSP without
   *   AprilTag.
   */
  [[nodiscard]] static std::unique_ptr<vpServoVision> tag(const std::string &family, int id, double size,
                                                          const vpCameraParameters &camera, double cornerSigma = 0.3);

  /*!
   * Source of poses, for poses(): sets the pose cMo of the object in the camera, m, and its covariance if there is one.
   * False: the target was not found.
   */
  using PoseSource =
      std::function<bool(const vpImage<unsigned char> &image, vpHomogeneousMatrix &cMo, vpPoseCovariance &covariance)>;
  //! Vision by any source of poses. \param source : Called once per image. \param target : Points of the object.
  //! \throw vpException (badValue) if \e source is empty.
  [[nodiscard]] static std::unique_ptr<vpServoVision> poses(PoseSource source, const vpServoTarget &target);

protected:
  vpServoVision() = default; //!< For derived classes.
};

END_VISP_NAMESPACE
#endif
