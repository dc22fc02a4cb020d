/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/servoing/vpReferenceVision.h>

#include <visp3/core/vpException.h>
#include <visp3/core/vpPixelMeterConversion.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

BEGIN_VISP_NAMESPACE

void vpReferenceVisionSpec::validate() const
{
  pose.validate();
  keypoints.validate();
  vpCheckField("points", "the reference vision", points, "", {20., 512.});
  vpCheckField("referenceNoise", "the reference vision", referenceNoise, "px", vpFieldRange::positive(10.));
}

namespace
{
constexpr double leastNoise = 0.02; // px, of a corner: unevenness and interpolation

const vpReferenceVisionSpec &checked(const vpReferenceVisionSpec &spec)
{
  spec.validate();
  return spec;
}

Eigen::Vector2d normalised(const vpCameraParameters &camera, const vpImagePoint &p)
{
  double x = 0., y = 0.;
  vpPixelMeterConversion::convertPoint(camera, p, x, y);
  return {x, y};
}

std::vector<Eigen::Vector2d> normalised(const vpCameraParameters &camera, const std::vector<vpImagePoint> &points)
{
  std::vector<Eigen::Vector2d> all;
  for (const vpImagePoint &p : points) {
    all.push_back(normalised(camera, p));
  }
  return all;
}
} // namespace

class vpReferenceVision::Impl
{
public:
  Impl(const vpImage<unsigned char> &reference, const vpCameraParameters &camera, const vpReferenceVisionSpec &spec)
    : m_camera(camera), m_focal(std::sqrt(camera.get_px() * camera.get_py())),
      m_tracker(reference, checked(spec).points, spec.keypoints),
      m_pose(normalised(camera, m_tracker.reference()), spec.referenceNoise / m_focal, spec.pose)
  {}

  void see(const vpImage<unsigned char> &image, double time, const vpRigidTransform *fMc, vpServoSight &sight)
  {
    find(image, fMc);
    const vpPlaneTrack &track = m_tracker.result();
    m_points.assign(m_tracker.reference().size(), vpServoPoint());
    for (std::size_t i = 0; i < m_points.size(); ++i) {
      m_points[i].visible = track.found && track.visible[i];
      if (m_points[i].visible) {
        const Eigen::Vector2d x = normalised(m_camera, track.points[i]);
        m_points[i].x = x.x();
        m_points[i].y = x.y();
      }
    }
    m_last.reset();
    m_message = track.message;
    if (track.found) {
      m_message += " " + m_pose.add(m_points, std::max(track.sigma, leastNoise) / m_focal, fMc).message;
      m_last = fMc ? std::optional<vpRigidTransform>(*fMc) : std::nullopt;
    }
    m_pose.sight(time, sight);
    sight.measurement.valid = sight.hasGoal = track.found && m_pose.result().found();
  }

  vpCameraParameters m_camera;
  double m_focal;
  vpPlaneTracker m_tracker;
  vpReferencePose m_pose;
  std::string m_message = "No image was given yet.";

private:
  void find(const vpImage<unsigned char> &image, const vpRigidTransform *fMc);
  [[nodiscard]] std::array<double, 9> expected(const vpRigidTransform *fMc) const;

  std::vector<vpServoPoint> m_points;
  std::optional<vpRigidTransform> m_last; // camera at the last image that showed the plane
};

void vpReferenceVision::Impl::find(const vpImage<unsigned char> &image, const vpRigidTransform *fMc)
{
  const bool wasFound = m_tracker.result().found;
  if (wasFound) {
    m_tracker.track(image, expected(fMc));
  }
  if (!m_tracker.result().found) {
    m_tracker.acquire(image);
  }
}

// The last homography, moved by odometry: K R^T (I - tau n^T) K^-1.
std::array<double, 9> vpReferenceVision::Impl::expected(const vpRigidTransform *fMc) const
{
  const vpReferencePoseResult &r = m_pose.result();
  if (!fMc || !m_last || !r.found()) {
    return m_tracker.result().homography;
  }
  const auto euclidean = [&r](const Eigen::Matrix3d &R, const Eigen::Vector3d &tau) {
    return Eigen::Matrix3d(R.transpose() * (Eigen::Matrix3d::Identity() - tau * r.normal.transpose()));
  };
  const vpRigidTransform moved = m_last->inverse() * *fMc;
  const Eigen::Matrix3d change =
      euclidean(r.R * moved.R, r.tau + r.R * moved.p / r.distance) * euclidean(r.R, r.tau).inverse();
  Eigen::Matrix3d K;
  K << m_camera.get_px(), 0., m_camera.get_u0(), 0., m_camera.get_py(), m_camera.get_v0(), 0., 0., 1.;
  std::array<double, 9> H = m_tracker.result().homography;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> map(H.data());
  const Eigen::Matrix3d predicted = K * change * K.inverse() * map;
  map = predicted / predicted(2, 2);
  return H;
}

vpReferenceVision::vpReferenceVision(const vpImage<unsigned char> &reference, const vpCameraParameters &camera,
                                     const vpReferenceVisionSpec &spec)
  : m_impl(std::make_unique<Impl>(reference, camera, spec))
{}

vpReferenceVision::~vpReferenceVision() = default;

void vpReferenceVision::see(const vpImage<unsigned char> &image, double time, const vpRigidTransform *fMc,
                            vpServoSight &sight)
{
  m_impl->see(image, time, fMc, sight);
}

vpServoGoal vpReferenceVision::goal(const vpHomogeneousMatrix &cdMo) const
{
  return m_impl->m_pose.target().goal(cdMo);
}

const std::string &vpReferenceVision::message() const { return m_impl->m_message; }

const vpPlaneTrack &vpReferenceVision::track() const { return m_impl->m_tracker.result(); }

const vpReferencePoseResult &vpReferenceVision::result() const { return m_impl->m_pose.result(); }

END_VISP_NAMESPACE
