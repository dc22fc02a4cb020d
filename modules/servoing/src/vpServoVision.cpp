/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/servoing/vpServoVision.h>

#include <visp3/core/vpException.h>

#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
class vpPhotographVision : public vpServoVision
{
public:
  vpPhotographVision(const vpImage<unsigned char> &photo, double width, double height, const vpCameraParameters &camera,
                     const vpPlanarTargetSpec &spec)
    : m_finder(photo, width, height, camera, spec), m_target(vpServoTarget::rectangle(width, height))
  {}

  void see(const vpImage<unsigned char> &image, double time, const vpRigidTransform *, vpServoSight &sight) VP_OVERRIDE
  {
    m_target.measure(m_finder.process(image), time, sight.measurement);
  }
  vpServoGoal goal(const vpHomogeneousMatrix &cdMo) const VP_OVERRIDE { return m_target.goal(cdMo); }
  const std::string &message() const VP_OVERRIDE { return m_finder.result().message; }

private:
  vpPlanarTarget m_finder;
  vpServoTarget m_target;
};

class vpPoseVision : public vpServoVision
{
public:
  vpPoseVision(PoseSource source, const vpServoTarget &target) : m_source(std::move(source)), m_target(target)
  {
    if (!m_source) {
      throw vpException(vpException::badValue, "the source of poses is empty, must be a function");
    }
  }

  void see(const vpImage<unsigned char> &image, double time, const vpRigidTransform *, vpServoSight &sight) VP_OVERRIDE
  {
    m_covariance = vpPoseCovariance();
    const bool isFound = m_source(image, m_cMo, m_covariance);
    sight.measurement.time = time;
    sight.measurement.valid = isFound;
    if (isFound) {
      m_target.measure(m_cMo, time, sight.measurement);
      sight.measurement.covariance = m_covariance;
    }
    m_message = isFound ? "The source of poses found the target." : "The source of poses did not find the target.";
  }
  vpServoGoal goal(const vpHomogeneousMatrix &cdMo) const VP_OVERRIDE { return m_target.goal(cdMo); }
  const std::string &message() const VP_OVERRIDE { return m_message; }

private:
  PoseSource m_source;
  vpServoTarget m_target;
  vpHomogeneousMatrix m_cMo;
  vpPoseCovariance m_covariance;
  std::string m_message = "No image was given yet.";
};
} // namespace

std::unique_ptr<vpServoVision> vpServoVision::photograph(const vpImage<unsigned char> &photo, double width,
                                                         double height, const vpCameraParameters &camera,
                                                         const vpPlanarTargetSpec &spec)
{
  return std::make_unique<vpPhotographVision>(photo, width, height, camera, spec);
}

std::unique_ptr<vpServoVision> vpServoVision::poses(PoseSource source, const vpServoTarget &target)
{
  return std::make_unique<vpPoseVision>(std::move(source), target);
}

END_VISP_NAMESPACE
