/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file keypointItems.h
 * \brief Items of keypointParts(), the views used by both tables, and the experiment of table 4.3.
 */
#ifndef thesisReport_keypointItems_h
#define thesisReport_keypointItems_h

#include "part.h"

#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpImage.h>
#include <visp3/planar_target/vpPlanarTarget.h>
#include <visp3/planar_target/vpPlaneMatcher.h>
#include <visp3/planar_target/vpTwoViewDecomposition.h>
#include <visp3/rendering/vpPlaneRenderer.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace thesisReport
{
VISP_DIRECT_USING_NAMESPACE

[[nodiscard]] std::vector<Item> keypointTable(const Setting &setting); //!< Table 4.2.
[[nodiscard]] std::vector<Item> poseTable(const Setting &setting);     //!< Table 4.3.

//! What the text says of the order of the accuracies of table 4.3, from the means that the thesis prints.
[[nodiscard]] std::vector<Quantity> ownOrders();

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

//! Octaves and scales of SURF in a column of table 4.2.
struct SurfScales {
  unsigned int octaves = 2, layers = 2; //!< Those of the second column, and of table 4.3.
  bool upright = false;                 //!< U-SURF.
};

/*!
 * A matcher by SURF with a threshold on the strength, as in the thesis, for reference and frames: the one with which the
 * reference has this number of keypoints. The thesis's own numbers, 800 and 1200, are of another scale.
 */
[[nodiscard]] vpPlaneMatcher surfMatcher(const vpImage<unsigned char> &reference, unsigned int keypoints,
                                         const SurfScales &scales = {});

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

//! Axes of the table: angles about z, x and y of the camera, and positions along x, y and z.
enum class PoseAxis { Roll, Pitch, Yaw, X, Y, Z };

[[nodiscard]] const char *nameOf(PoseAxis axis); //!< "roll".
[[nodiscard]] bool isAngle(PoseAxis axis);       //!< Degrees; else thousandths of the plane's distance.
[[nodiscard]] std::string unitOf(PoseAxis axis); //!< " deg", or nothing.

//! \brief Estimated minus true offset over several views, in the unit of the axis.
struct PoseErrors {
  Spread surf;      //!< SURF, homography, decomposition.
  Spread wrongLens; //!< Same matches, focal length 1 % too long.
  Spread refined;   //!< vpPlanarTarget.
  Spread centre;    //!< Same matches: position of the object's centre instead of the camera's motion; angles as surf.
  Spread matches;   //!< Matches per view that agree with the plane.
  int lost = 0;     //!< Views in which SURF gave no motion.
};

//! \brief The photograph is moved along or about one axis, and its motion is estimated: views at an offset, differing in noise and occlusion.
class PoseExperiment
{
public:
  explicit PoseExperiment(unsigned int seed);
  //! \param busy : Another photograph behind the object.
  [[nodiscard]] PoseErrors run(PoseAxis axis, double offset, bool busy);

private:
  void compare(const vpPlaneMatch &match, PoseAxis axis, double offset, PoseErrors &errors) const;
  void refine(const vpImage<unsigned char> &image, PoseAxis axis, double offset, PoseErrors &errors);

  unsigned int m_seed;
  unsigned int m_views = 0; // so far; each has its own noise
  KeypointScene m_scene;
  std::unique_ptr<vpPlaneMatcher> m_matcher;
  std::unique_ptr<vpPlanarTarget> m_target;
};

//! Chosen parameters, for the report.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> poseParameters();
} // namespace thesisReport

#endif
