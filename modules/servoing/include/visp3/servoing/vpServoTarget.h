/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoTarget.h
 * \brief Converts the pose of a known object to measurements and goals of servo laws.
 */
#ifndef vpServoTarget_h
#define vpServoTarget_h

#include <visp3/feedforward/vpServoMeasurement.h>
#include <visp3/planar_target/vpPlanarTargetResult.h>

#include <Eigen/Core>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpServoTarget
 * \ingroup group_servoing
 * \brief Object points used by a law: their images at the goal and at a measured pose.
 *
 * \code
 * const vpServoTarget plate = vpServoTarget::rectangle(0.16, 0.11); // m
 * vpPlanarTarget target(photo, 0.16, 0.11, camera);
 * law.setGoal(plate.goal(cdMo));
 * plate.measure(target.process(image), now(), measurement); // each frame
 * const vpServoCommand command = law.step(measurement, dt); // Holding where the target was not found
 * \endcode
 */
class VISP_EXPORT vpServoTarget
{
public:
  /*!
   * \param points : Features of the object in its own frame, m; at least one.
   * \param outline : Points that must stay in view, in the object's frame, m; empty: \e points.
   * \throw vpException (badValue) when there is no point or a coordinate is not finite.
   */
  explicit vpServoTarget(std::vector<Eigen::Vector3d> points, std::vector<Eigen::Vector3d> outline = {});
  /*!
   * Corners of a rectangle in the plane z = 0 centred at the origin: top left, top right, bottom right, bottom left.
   * \param width, height : Size, m, > 0.
   * \throw vpException (badValue) naming the side that is out of range.
   */
  [[nodiscard]] static vpServoTarget rectangle(double width, double height);

  //! Goal for a law. \param cdMo : Pose of the object in the desired camera frame, m.
  [[nodiscard]] vpServoGoal goal(const vpHomogeneousMatrix &cdMo) const;
  /*!
   * Measurement of a camera that sees the object at \e cMo; points behind the camera are not visible. Allocates only
   * until \e result has its size.
   * \param cMo : Pose of the object in the camera, m. \param time : Time of exposure, s.
   * \param result : All of its fields are set.
   */
  void measure(const vpHomogeneousMatrix &cMo, double time, vpServoMeasurement &result) const;
  //! Measurement from a target found in an image, with its covariance; invalid unless vpPlanarTargetResult::found().
  void measure(const vpPlanarTargetResult &seen, double time, vpServoMeasurement &result) const;
  /*!
   * Images of points of an object at \e cMo; a point behind the camera is not visible and keeps its previous numbers.
   * \param points : Points in the object's frame, m. \param cMo : Pose of the object in the camera, m. \param images :
   *   Receives one image for each point; allocates only when it grows.
   */
  static void project(const std::vector<Eigen::Vector3d> &points, const vpHomogeneousMatrix &cMo,
                      std::vector<vpServoPoint> &images);
  //! Features in the object's frame, m.
  [[nodiscard]] const std::vector<Eigen::Vector3d> &points() const { return m_points; }
  //! Points that must stay in view, in the object's frame, m.
  [[nodiscard]] const std::vector<Eigen::Vector3d> &outline() const { return m_outline; }

private:
  std::vector<Eigen::Vector3d> m_points, m_outline;
};

END_VISP_NAMESPACE
#endif
