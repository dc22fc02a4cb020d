/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpObstacleDetector.h
 * \brief Detects obstacles in images (thesis 8.3.2). Requires a build with the module planar_target.
 */
#ifndef vpObstacleDetector_h
#define vpObstacleDetector_h

#include <visp3/avoidance/vpObjectTracks.h>
#include <visp3/planar_target/vpPlanarTargetDatabase.h>

#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief Parameters of vpObstacleDetector.
 */
struct VISP_EXPORT vpObstacleDetectorSpec {
  double thickness = 0.02;           //!< Thickness of a body without depth in the database, m, > 0.
  double pixelSigma = 0.06;          //!< Sigma of each target corner in a clear image, px, > 0.
  double greySigma = 0.8;            //!< Sigma of each corner when noise equals contrast, px, >= 0.
  double cameraPositionSigma = 5e-4; //!< Standard deviation of each coordinate of fMc, m, >= 0.
  double cameraAngleSigma = 1e-3;    //!< Standard deviation of each rotation component of fMc, rad, >= 0.
  double scaleSigma = 1e-3;          //!< Relative sigma of photograph sizes and focal length, >= 0.
  double maxPositionSigma = 0.05;    //!< Detections with a larger position sigma are not reported, m, > 0.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \ingroup group_avoidance
 * \brief Detection of one obstacle of the database in an image.
 */
struct VISP_EXPORT vpObstacleDetection {
  vpObjectSighting sighting; //!< Sighting; name and shape are always set, the rest only if seen.
  bool seen = false;         //!< True if the sighting is valid.
  vpPlanarTargetStatus status = vpPlanarTargetStatus::NoFrame; //!< Status of its target.
  std::string message;                                         //!< Result, or why it was not seen.
};

/*!
 * \class vpObstacleDetector
 * \ingroup group_avoidance
 * \brief Detects obstacles in the base frame from an image and the camera pose.
 *
 * Every obstacle is a box with a known photograph on its front: width and height are those of the photograph, which set
 * the metric scale, and it extends vpPlanarTargetSighting::depth behind it. The box's frame is at its centre, its z
 * axis points into the photograph.
 *
 * Each target is searched where the camera motion and its own last motion predict it, so that both may move farther
 * between images than tracking alone could handle.
 *
 * The standard deviations follow from the geometry of the view: the information of the target's corners about the pose,
 * each with a sigma of vpObstacleDetectorSpec::pixelSigma, or more for a lower correlation of the image with the
 * photograph. Depth is less accurate than the other two coordinates; the sighting reports the worst direction. The
 * uncertainties of camera position, camera rotation and sizes are added.
 *
 * \code
 * vpPlanarTargetDatabase targets(camera, vpObstacleDetector::fastTargets());
 * targets.add("box", photo, 0.16, 0.11, 0.06); // width, height and depth, m
 * vpObstacleDetector detector(std::move(targets), camera);
 * vpObjectTracks tracks;
 * vpArmData data;
 * vpArmKinematics::update(arm, q, data); // when the image was taken
 * for (const vpObstacleDetection &found : detector.process(image, vpArmKinematics::camera(arm, data), now())) {
 *   if (found.seen) {
 *     tracks.add(found.sighting); // +- found.sighting.positionSigma
 *   }
 *   else {
 *     std::cerr << found.message << std::endl;
 *   }
 * }
 * \endcode
 */
class VISP_EXPORT vpObstacleDetector
{
public:
  /*!
   * Target settings for a control loop: no second kind of keypoints, which takes longer than a frame, and refinement at
   * 120 px, which is as accurate as 200 px in a third of the time.
   */
  [[nodiscard]] static vpPlanarTargetSpec fastTargets();
  /*!
   * \param targets : The photographs; created for \e camera. \param camera : Intrinsics of the images.
   * \param spec : Parameters; copied.
   * \throw vpException (badValue), see vpObstacleDetectorSpec::validate(), or naming the database if it is empty.
   */
  vpObstacleDetector(vpPlanarTargetDatabase targets, const vpCameraParameters &camera,
                     const vpObstacleDetectorSpec &spec = {});

  /*!
   * Detects all obstacles in an image.
   * \param image : As for vpPlanarTargetDatabase::process(). \param fMc : Camera in the base at exposure; if not
   * finite, nothing is seen. \param time : Time of exposure, s; becomes vpObjectSighting::time.
   * \return One entry per target, in the order of the database.
   */
  const std::vector<vpObstacleDetection> &process(const vpImage<unsigned char> &image, const vpRigidTransform &fMc,
                                                  double time);
  //! The last result; all NoFrame before the first image.
  [[nodiscard]] const std::vector<vpObstacleDetection> &detections() const noexcept { return m_detections; }
  //! Targets as seen in the last image, for drawing.
  [[nodiscard]] const std::vector<vpPlanarTargetSighting> &targets() const { return m_targets.sightings(); }
  //! Clears the remembered target motions.
  void reset();

private:
  struct Memory {
    vpRigidTransform fMo; // of the target, in the last image
    Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero(); // in the base
    double time = 0.;
    bool isKnown = false;
  };
  void predict(const vpRigidTransform &fMc, double time);
  static void remember(const vpRigidTransform &fMo, double time, Memory &memory);
  void conclude(const vpPlanarTargetSighting &target, const vpRigidTransform &fMc, double time,
                vpObstacleDetection &detection) const;

  vpPlanarTargetDatabase m_targets;
  vpCameraParameters m_camera;
  vpObstacleDetectorSpec m_spec;
  std::vector<vpObstacleDetection> m_detections;
  std::vector<Memory> m_memory; // one for each target
};

END_VISP_NAMESPACE
#endif
