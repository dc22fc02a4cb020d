/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFieldCheck.h"
#include "vpSquarePose.h"

#include <visp3/core/vpConfig.h>
#include <visp3/core/vpException.h>
#include <visp3/core/vpPixelMeterConversion.h>
#include <visp3/detection/vpDetectorAprilTag.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/servoing/vpServoVision.h>

#include <map>
#include <utility>

BEGIN_VISP_NAMESPACE

#ifdef VISP_HAVE_APRILTAG
namespace
{
constexpr double decided = 13.8;      // difference of the misfits: odds of 1000 against the other pose
constexpr double largestMisfit = 30.; // chi-square with 2 degrees of freedom: 3e-7; a part of the tag is hidden
constexpr double carefully = 0.3;     // factor on the speed while two poses fit

const std::map<std::string, vpDetectorAprilTag::vpAprilTagFamily> families = {
    {"36h11", vpDetectorAprilTag::TAG_36h11},
    {"25h9", vpDetectorAprilTag::TAG_25h9},
    {"16h5", vpDetectorAprilTag::TAG_16h5},
    {"Circle21h7", vpDetectorAprilTag::TAG_CIRCLE21h7},
    {"Standard41h12", vpDetectorAprilTag::TAG_STANDARD41h12}};

vpDetectorAprilTag::vpAprilTagFamily familyOf(const std::string &name)
{
  const auto found = families.find(name);
  if (found == families.end()) {
    std::string known;
    for (const auto &family : families) {
      known += (known.empty() ? "" : ", ") + family.first;
    }
    throw vpException(vpException::badValue, "the family of tags \"%s\" is unknown, known are: %s", name.c_str(),
                      known.c_str());
  }
  return found->second;
}

class vpTagVision : public vpServoVision
{
public:
  vpTagVision(const std::string &family, int id, double size, const vpCameraParameters &camera, double cornerSigma)
    : m_detector(familyOf(family)), m_target(vpServoTarget::rectangle(size, size)), m_camera(camera), m_id(id),
      m_size(size), m_sigma(cornerSigma / std::min(camera.get_px(), camera.get_py()))
  {
    constexpr vpFieldCheck fields("the tag");
    fields.positive("cornerSigma", cornerSigma, "px");
    fields.require(id >= 0, "id", id, ">= 0");
    m_detector.setAprilTagQuadDecimate(1.F);
  }

  void see(const vpImage<unsigned char> &image, double time, const vpRigidTransform *fMc,
           vpServoSight &sight) VP_OVERRIDE
  {
    sight.measurement.valid = false;
    sight.measurement.time = time;
    std::array<Eigen::Vector2d, 4> corners;
    if (!findCorners(image, corners)) {
      m_message = "Tag " + std::to_string(m_id) + " was not found.";
      return;
    }
    const vpSquarePoses poses = vpFitSquare(corners, m_size, m_sigma);
    if (!poses.best.isValid || poses.best.misfit > largestMisfit) {
      m_message = "The corners of tag " + std::to_string(m_id) + " are not those of a square.";
      return;
    }
    const bool isAmbiguous = poses.rival.isValid && poses.rival.misfit - poses.best.misfit < decided;
    const vpSquareFit &fit = isAmbiguous && prefersRival(poses, fMc) ? poses.rival : poses.best;
    m_target.measure(fit.cMo.toHomogeneous(), time, sight.measurement);
    sight.measurement.covariance = fit.covariance;
    sight.speedFactor = isAmbiguous ? carefully : 1.;
    m_last = fMc ? *fMc * fit.cMo : fit.cMo;
    m_hasLast = true;
    m_message = isAmbiguous ? "Tag " + std::to_string(m_id) + " was found, but two poses fit it."
                            : "Tag " + std::to_string(m_id) + " was found.";
  }
  vpServoGoal goal(const vpHomogeneousMatrix &cdMo) const VP_OVERRIDE { return m_target.goal(cdMo); }
  const std::string &message() const VP_OVERRIDE { return m_message; }

private:
  bool findCorners(const vpImage<unsigned char> &image, std::array<Eigen::Vector2d, 4> &corners)
  {
    m_detector.detect(image);
    const std::vector<int> ids = m_detector.getTagsId();
    const auto found = std::find(ids.begin(), ids.end(), m_id);
    if (found == ids.end()) {
      return false;
    }
    const std::vector<vpImagePoint> polygon =
        m_detector.getTagsCorners()[static_cast<std::size_t>(found - ids.begin())];
    for (std::size_t i = 0; i < 4; ++i) { // bottom left, bottom right, top right, top left
      // AprilTag counts from the corner of the first pixel, ViSP's cameras from its centre.
      const vpImagePoint centred(polygon[i].get_i() - 0.5, polygon[i].get_j() - 0.5);
      double x = 0., y = 0.;
      vpPixelMeterConversion::convertPoint(m_camera, centred, x, y);
      corners[3 - i] = {x, y};
    }
    return true;
  }
  // By the last pose, moved with the camera.
  [[nodiscard]] bool prefersRival(const vpSquarePoses &poses, const vpRigidTransform *fMc) const
  {
    if (!m_hasLast) {
      return false;
    }
    const vpRigidTransform expected = fMc ? fMc->inverse() * m_last : m_last;
    const auto off = [&expected](const vpSquareFit &fit) {
      return vpSO3::log(expected.R.transpose() * fit.cMo.R).norm();
    };
    return off(poses.rival) < off(poses.best);
  }

  vpDetectorAprilTag m_detector;
  vpServoTarget m_target;
  vpCameraParameters m_camera;
  int m_id;
  double m_size, m_sigma;
  vpRigidTransform m_last; // in the base; in the camera where its pose is not known
  bool m_hasLast = false;
  std::string m_message = "No image was given yet.";
};
} // namespace

std::unique_ptr<vpServoVision> vpServoVision::tag(const std::string &family, int id, double size,
                                                  const vpCameraParameters &camera, double cornerSigma)
{
  return std::make_unique<vpTagVision>(family, id, size, camera, cornerSigma);
}
#else
std::unique_ptr<vpServoVision> vpServoVision::tag(const std::string &, int, double, const vpCameraParameters &, double)
{
  throw vpException(vpException::notImplementedError, "tags need a ViSP with AprilTag, and this one was built without");
}
#endif

END_VISP_NAMESPACE
