/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file keypointItems.h
 * \brief Items of keypointParts(), and the views used by both tables.
 */
#ifndef thesisReport_keypointItems_h
#define thesisReport_keypointItems_h

#include "part.h"

#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpImage.h>
#include <visp3/planar_target/vpPlaneMatcher.h>
#include <visp3/rendering/vpPlaneRenderer.h>

namespace thesisReport
{
VISP_DIRECT_USING_NAMESPACE

[[nodiscard]] std::vector<Item> keypointTable(const Setting &setting); //!< Table 4.2.
[[nodiscard]] std::vector<Item> poseTable(const Setting &setting);     //!< Table 4.3.

//! Camera of both tables: 640 x 480 px, focal length 800 px.
[[nodiscard]] vpCameraParameters keypointCamera();

//! Pose from a position (m) and angles about the camera axes (rad): roll about z, pitch about x, yaw about y.
[[nodiscard]] vpHomogeneousMatrix poseOf(double x, double y, double z, double roll, double pitch, double yaw);

/*!
 * A matcher whose reference has approximately the given number of keypoints: dlib's SURF omits some of the requested
 * ones.
 */
[[nodiscard]] vpPlaneMatcher matcherWith(const vpImage<unsigned char> &reference, vpKeypointType type,
                                         unsigned int keypoints);

/*!
 * \brief Camera views of a real photograph (data/target/klimt.jpg, 0.2 m wide) in front of another one
 * (starry-night.jpg).
 */
class KeypointScene
{
public:
  KeypointScene();
  //! The photograph itself.
  [[nodiscard]] const vpImage<unsigned char> &photograph() const { return m_photo; }
  [[nodiscard]] double width() const { return m_width; }   //!< m.
  [[nodiscard]] double height() const { return m_height; } //!< m.
  //! Reference view of the photograph alone, on the renderer's faint background. Parameters as for render().
  void renderAlone(const vpHomogeneousMatrix &cMo, const vpCameraFaults &faults, unsigned int seed,
                   vpImage<unsigned char> &image);
  /*!
   * \param cMo : Photograph in the camera. \param faults : Noise affects both photographs, an occluder the first.
   * \param seed : Noise seed.
   */
  void render(const vpHomogeneousMatrix &cMo, const vpCameraFaults &faults, unsigned int seed,
              vpImage<unsigned char> &image);

private:
  vpImage<unsigned char> m_photo;
  double m_width, m_height;
  vpPlaneRenderer m_target, m_background;
};
} // namespace thesisReport

#endif
