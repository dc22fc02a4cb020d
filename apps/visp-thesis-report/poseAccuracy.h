/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file poseAccuracy.h
 * \brief The experiment of table 4.3: a photograph is moved along or about one axis, and its motion is estimated.
 */
#ifndef thesisReport_poseAccuracy_h
#define thesisReport_poseAccuracy_h

#include "keypointItems.h"
#include "spread.h"

#include <visp3/planar_target/vpPlanarTarget.h>
#include <visp3/planar_target/vpPlaneMatcher.h>
#include <visp3/planar_target/vpTwoViewDecomposition.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace thesisReport
{
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

//! \brief Views of the photograph at an offset, differing in noise and occlusion.
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
