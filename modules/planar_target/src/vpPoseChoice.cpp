/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPoseChoice.h"

#include <visp3/direct_core/vpSO3.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double sure = 9.2, sureSpreads = 3.; // log of 10,000
constexpr double fading = 0.9;                 // decay of the evidence from frame to frame
constexpr double mostEvidence = 50.;           // limit, so that a few frames can change it
constexpr double sameTurn2 = 9.;               // squared deviations of the rotation; covariance covers both
constexpr double farDistance = 60.;            // deviations between two images that are clearly different
constexpr double plainEvidence = 100.;         // evidence of a first comparison, of the expected farDistance^2 / 2
constexpr double plainKappa = 3.;              // of a fit that no other pose could improve much
constexpr double oneTurn = 0.3;                // share of the rotation to the rival; closer, both are one pose
constexpr float cut = 22.f;                    // squared deviations; beyond it neither fits
constexpr int block = 12;                      // px, see Evidence
constexpr double smallestFrontality = 0.05;    // rivals viewed more obliquely are excluded

double turnBetween(const Eigen::Matrix3d &a, const Eigen::Matrix3d &b) { return vpSO3::log(a * b.transpose()).norm(); }
double turnBetween(const vpRigidPose &a, const vpRigidPose &b) { return turnBetween(a.R, b.R); }

// Squared deviations between the orientations of a fit and another pose.
double turn2(const vpPixelFit &fit, const vpRigidPose &other)
{
  const Eigen::Vector3d w = vpSO3::log(other.R * fit.pose.R.transpose());
  const Eigen::Matrix3d C = fit.covariance.bottomRightCorner<3, 3>();
  return w.dot(C.ldlt().solve(w));
}
} // namespace

vpRigidPose rivalPose(const vpRigidPose &pose, const Eigen::Vector2d &pivot)
{
  const Eigen::Vector3d place = pose.R.leftCols<2>() * pivot + pose.t;
  const Eigen::Vector3d sight = place.normalized(), normal = pose.R.col(2);
  const Eigen::Vector3d turned = 2. * sight * sight.dot(normal) - normal;
  vpRigidPose rival = pose;
  for (int i = 0; i < 2; ++i) {
    // The part across the line of sight stays; the part along it rotates the axis into the turned plane.
    const Eigen::Vector3d across = pose.R.col(i) - sight * sight.dot(pose.R.col(i));
    rival.R.col(i) = across - sight * (turned.dot(across) / turned.dot(sight));
  }
  rival.R.col(0).normalize();
  rival.R.col(1) -= rival.R.col(0) * rival.R.col(0).dot(rival.R.col(1));
  rival.R.col(1).normalize();
  rival.R.col(2) = rival.R.col(0).cross(rival.R.col(1));
  rival.t = place - rival.R.leftCols<2>() * pivot;
  return rival;
}

vpRigidPose vpPoseChoice::mirrored(const cv::Mat &image, const vpRigidPose &pose) const
{
  return rivalPose(pose, seenCentre(m_plane, pose, m_camera, image.cols, image.rows));
}

// True if the first refiner's pose fits, and the rival is so different that its exact pose does not matter.
bool vpPoseChoice::isPlain(const cv::Mat &image, const vpRigidPose &rival)
{
  const vpPixelFit &fit = m_refiners[0].fit();
  if (fit.kappa > plainKappa || !m_refiners[1].glance(image, rival, fit.camera)) {
    return false;
  }
  const Evidence evidence = compare();
  return evidence.L > plainEvidence && evidence.L > sureSpreads * std::sqrt(evidence.variance);
}

// True if the mirrored pose, which has no fit, is as good as the first refiner's.
bool vpPoseChoice::isDoubtful(const cv::Mat &image, const vpRigidPose &rival)
{
  if (!m_refiners[1].glance(image, rival, m_refiners[0].fit().camera)) {
    return false;
  }
  const Evidence evidence = compare();
  return !(evidence.L > sure && evidence.L > sureSpreads * std::sqrt(evidence.variance));
}

// True if there is a rival, refined.
bool vpPoseChoice::refineRival(const cv::Mat &image)
{
  const vpPixelFit &fit = m_refiners[0].fit();
  if (frontality(fit.pose) < smallestFrontality) {
    return false;
  }
  const vpRigidPose start = mirrored(image, fit.pose);
  // Where the perspective is strong, the pose is decided immediately when tracked, or after a first comparison.
  if (turn2(fit, start) < sameTurn2 ||
      (m_refiners[0].distance(start) > farDistance && (m_memory || isPlain(image, start)))) {
    return false;
  }
  const double whole = turnBetween(start, fit.pose);
  if (!m_refiners[1].refine(image, start, fit.camera).converged) {
    m_decision.doubtful = !m_memory && fit.kappa > plainKappa && isDoubtful(image, start);
    return false;
  }
  // Both restart from their results: a prediction that is linear over a longer way fits differently, by a relevant
  // amount.
  const vpPixelFit first = fit, second = m_refiners[1].fit();
  return m_refiners[0].refine(image, first.pose, first.camera).converged &&
         m_refiners[1].refine(image, second.pose, first.camera).converged &&
         turnBetween(m_refiners[1].fit().pose, fit.pose) > oneTurn * whole;
}

// Evidence of one frame for the first refiner's pose: same pixels, same deviation.
vpPoseChoice::Evidence vpPoseChoice::compare() const
{
  const vpPixelRefiner &a = m_refiners[0], &b = m_refiners[1];
  const double s = std::min(a.fit().sigma, b.fit().sigma);
  const float limit = cut * static_cast<float>(s * s);
  const cv::Rect area = a.area() & b.area();
  const int across = area.width / block + 1, down = area.height / block + 1;
  std::vector<double> sums(static_cast<std::size_t>(across) * static_cast<std::size_t>(down), 0.);
  std::vector<int> counts(sums.size(), 0);
  for (int v = 0; v < area.height; ++v) {
    const int ra = area.y - a.area().y + v, rb = area.y - b.area().y + v;
    const float *const ea = a.residuals().ptr<float>(ra) + area.x - a.area().x;
    const float *const eb = b.residuals().ptr<float>(rb) + area.x - b.area().x;
    const float *const oa = a.open().ptr<float>(ra) + area.x - a.area().x;
    const float *const ob = b.open().ptr<float>(rb) + area.x - b.area().x;
    for (int u = 0; u < area.width; ++u) {
      if (oa[u] > 0.f && ob[u] > 0.f) {
        const std::size_t i = static_cast<std::size_t>(v / block * across + u / block);
        sums[i] += std::min(eb[u] * eb[u], limit) - std::min(ea[u] * ea[u], limit);
        ++counts[i];
      }
    }
  }
  Evidence evidence;
  double used = 0.;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i] /= 2. * s * s;
    evidence.L += sums[i];
    used += counts[i] > 0;
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (counts[i] > 0) {
      const double e = sums[i] - evidence.L / used;
      evidence.variance += e * e;
    }
  }
  return evidence;
}

// Adds the evidence of this frame to the previous evidence and selects the more likely pose.
void vpPoseChoice::conclude(Evidence now)
{
  const vpPixelFit &a = m_refiners[0].fit(), &b = m_refiners[1].fit();
  if (m_memory) {
    // Which of the two was the best before?
    const vpRigidPose &best = m_memory->best;
    const bool swapped = turnBetween(b.pose, best) < turnBetween(a.pose, best);
    now.L += (swapped ? -fading : fading) * m_memory->evidence.L;
    now.variance += fading * fading * m_memory->evidence.variance;
  }
  const bool first = now.L >= 0.;
  m_decision.best = first ? a : b;
  m_decision.rival = first ? b : a;
  m_decision.evidence = std::abs(now.L);
  m_decision.spreads = m_decision.evidence / std::sqrt(std::max(now.variance, 1e-12));
  m_decision.certain = m_decision.evidence > sure && m_decision.spreads > sureSpreads;
  // Limited together, so that their ratio stays.
  const double hold = std::min(1., mostEvidence / std::max(m_decision.evidence, 1e-12));
  m_memory =
      Memory{m_decision.best.pose, m_decision.rival->pose.R, {hold * m_decision.evidence, hold * hold * now.variance}};
}

bool vpPoseChoice::follows(const vpRigidPose &pose) const
{
  return m_memory && turnBetween(pose.R, m_memory->best.R) <= turnBetween(pose.R, m_memory->mirrored);
}

const vpPoseDecision &vpPoseChoice::decide(const cv::Mat &image, const vpRigidPose &pose, const vpCameraState &camera)
{
  m_decision = vpPoseDecision();
  if (!follows(pose)) {
    forget();
  }
  m_decision.best = m_refiners[0].refine(image, pose, camera);
  if (!m_decision.best.converged) {
    forget();
  }
  else if (refineRival(image)) {
    conclude(compare());
  }
  else {
    m_decision.certain = !m_decision.doubtful;
    m_memory = Memory{m_decision.best.pose, mirrored(image, m_decision.best.pose).R, Evidence()};
  }
  return m_decision;
}

END_VISP_NAMESPACE
