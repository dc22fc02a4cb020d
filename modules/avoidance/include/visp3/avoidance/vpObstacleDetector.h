/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpObstacleDetector.h
 * \brief Obstacles from pictures (thesis 8.3.2). Needs the module planar_target when this one is built.
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
  double thickness = 0.02;           //!< Of a body whose depth the database does not tell, m, > 0.
  double pixelSigma = 0.06;          //!< How far a clear picture leaves each corner of a target uncertain, px, > 0.
  double greySigma = 0.8;            //!< The same for a picture whose noise is as strong as its contrast, px, >= 0.
  double cameraPositionSigma = 5e-4; //!< Of fMc: standard deviation of each coordinate, m, >= 0.
  double cameraAngleSigma = 1e-3;    //!< Of each component of its rotation, rad, >= 0.
  double scaleSigma = 1e-3;          //!< Of the sizes of photographs and the focal length, relative, >= 0.
  double maxPositionSigma = 0.05;    //!< What is known no better is not reported, m, > 0.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \ingroup group_avoidance
 * \brief What a picture shows of one obstacle of the database.
 */
struct VISP_EXPORT vpObstacleDetection {
  vpObjectSighting sighting; //!< Its name and shape are always set, the rest when it was seen.
  bool seen = false;         //!< True when the sighting may be used.
  vpPlanarTargetStatus status = vpPlanarTargetStatus::NoFrame; //!< Of its picture.
  std::string sentence;                                        //!< How it went, or why it was not seen.
};

/*!
 * \class vpObstacleDetector
 * \ingroup group_avoidance
 * \brief Picture and place of the camera in, obstacles in the base frame out.
 *
 * Every obstacle is a box with a known photograph on its front: width and height are those of the photograph, which make
 * everything metric, and it reaches vpPlanarTargetSighting::depth behind it. The box's frame is in its middle, its z axis
 * points into the photograph.
 *
 * A target is looked for where it would be by the motion of the camera and its own last motion, so that both may move
 * farther between pictures than tracking alone would bridge.
 *
 * The deviations come from the geometry of the view: the information that the target's corners have about the pose,
 * when each is uncertain by vpObstacleDetectorSpec::pixelSigma, or more as the picture correlates less with the
 * photograph. Depth is worse than the other two coordinates; the sighting carries the worst direction. Deviations of the
 * camera's place and rotation and of all that is known of sizes are added.
 */
class VISP_EXPORT vpObstacleDetector
{
public:
  /*!
   * Settings of the targets for a control loop: no second kind of keypoints, which takes longer than a frame, and a
   * refinement at 120 px, which is as accurate as at 200 px in a third of the time.
   */
  [[nodiscard]] static vpPlanarTargetConfig fastTargets();
  /*!
   * \param targets : The photographs; made for \e camera. \param camera : Of the pictures.
   * \param spec : Parameters; copied.
   * \throw vpException (badValue), see vpObstacleDetectorSpec::validate(), or naming the database when it is empty.
   */
  vpObstacleDetector(vpPlanarTargetDatabase targets, const vpCameraParameters &camera,
                     const vpObstacleDetectorSpec &spec = {});

  /*!
   * All obstacles of a picture.
   * \param image : As for vpPlanarTargetDatabase::process(). \param fMc : Camera in the base at the exposure; when it is
   * not finite nothing is seen. \param time : Of the exposure, s; becomes vpObjectSighting::time.
   * \return One entry for each target, in the order of the database.
   */
  const std::vector<vpObstacleDetection> &process(const vpImage<unsigned char> &image, const vpRigidTransform &fMc,
                                                  double time);
  //! The last result; all NoFrame before the first picture.
  [[nodiscard]] const std::vector<vpObstacleDetection> &detections() const noexcept { return m_detections; }
  //! The targets as they were seen in the last picture, for drawing.
  [[nodiscard]] const std::vector<vpPlanarTargetSighting> &targets() const { return m_targets.sightings(); }
  //! Forgets where everything was.
  void reset();

private:
  struct Memory {
    vpRigidTransform fMo; // of the target, in the last picture
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
