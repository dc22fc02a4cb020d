/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpReferenceHypotheses.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/planar_target/vpTwoViewDecomposition.h>
#include <visp3/vision/vpHomography.h>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr std::size_t mostKeys = 24, mostRecent = 8;
constexpr unsigned int mostProposals = 6;                // key images whose homographies give hypotheses
constexpr double keyMotion = 0.05;                       // of the distance, and rad, between key images
constexpr double unlikely = 30.;                         // difference of the cost: e^15
constexpr double sameNormal = 0.05, sameRotation = 0.02; // rad
constexpr double worstMisfit = 4.; // beyond any wrong sigma: the plane moved, or the matches are wrong
constexpr double narrowest = 1e-6; // range of 1/d, relative
constexpr double memory = 0.9;     // of what earlier images said, without odometry
constexpr int firstSteps = 20, nextSteps = 10;

vpHomography homographyOf(const std::vector<Eigen::Vector2d> &reference, const vpReferenceView &view)
{
  std::vector<double> x1, y1, x2, y2;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (view.visible[i]) {
      x1.push_back(reference[i].x());
      y1.push_back(reference[i].y());
      x2.push_back(view.points[i].x());
      y2.push_back(view.points[i].y());
    }
  }
  vpHomography cHr;
  vpHomography::DLT(x1, y1, x2, y2, cHr, true);
  return cHr;
}

template <class Rows> Eigen::Matrix3d matrixOf(const Rows &rows)
{
  Eigen::Matrix3d M;
  for (unsigned int i = 0; i < 3; ++i) {
    for (unsigned int j = 0; j < 3; ++j) {
      M(i, j) = rows[i][j];
    }
  }
  return M;
}
} // namespace

vpReferenceHypotheses::vpReferenceHypotheses(const std::vector<Eigen::Vector2d> &reference, double sigma,
                                             const vpReferencePoseSpec &spec)
  : m_reference(reference), m_batch(reference, sigma)
{
  const double low = 1. / spec.farthest, high = 1. / spec.nearest;
  m_prior.alpha = 0.5 * (low + high);
  const double deviation = std::max(0.25 * (high - low), narrowest * m_prior.alpha);
  m_prior.alphaWeight = 1. / (deviation * deviation);
  setNormalPrior(Eigen::Vector3d::UnitZ(), spec.tilt);
}

void vpReferenceHypotheses::setNormalPrior(const Eigen::Vector3d &normal, double sigma)
{
  m_prior.normal = normal;
  m_prior.normalInformation = Eigen::Matrix2d::Identity() / (sigma * sigma);
}

void vpReferenceHypotheses::clear()
{
  m_views.clear();
  m_planes.clear();
  m_proposals = 0;
}

bool vpReferenceHypotheses::add(const vpReferenceView &view, bool hasOdometry)
{
  if (hasOdometry != m_hasOdometry) {
    clear();
    m_hasOdometry = hasOdometry;
  }
  const std::vector<Plane> before = m_planes;
  predict(view.fMc);
  keep(view);
  const auto failed = [this](Plane &plane) { return !refine(plane, nextSteps); };
  m_planes.erase(std::remove_if(m_planes.begin(), m_planes.end(), failed), m_planes.end());
  if (m_planes.empty() || (m_views.back().key && m_proposals < mostProposals)) {
    propose();
  }
  prune();
  if (!fits()) {
    m_planes = before;
    m_views.pop_back();
    return false;
  }
  m_last = view.fMc;
  learn();
  return true;
}

// The camera's pose at capture, by its motion since the last image.
void vpReferenceHypotheses::predict(const vpRigidTransform &fMc)
{
  const vpRigidTransform motion = m_last.inverse() * fMc;
  for (Plane &plane : m_planes) {
    plane.h.tau += plane.h.alpha * plane.h.R * motion.p;
    plane.h.R = plane.h.R * motion.R;
  }
}

// Motion of the camera between two images, in units of the distance and rad.
double vpReferenceHypotheses::moved(const vpRigidTransform &from, const vpRigidTransform &to) const
{
  const double alpha = m_planes.empty() ? m_prior.alpha : std::max(m_planes.front().h.alpha, 0.);
  return std::max(alpha * (to.p - from.p).norm(), vpSO3::log(from.R.transpose() * to.R).norm());
}

void vpReferenceHypotheses::keep(const vpReferenceView &view)
{
  if (!m_hasOdometry) {
    m_views.clear();
  }
  const auto lastKey = std::find_if(m_views.rbegin(), m_views.rend(), [](const auto &v) { return v.key; });
  const bool key = lastKey == m_views.rend() || moved(lastKey->fMc, view.fMc) > keyMotion;
  m_views.push_back(view);
  m_views.back().key = key;
  makeRoom();
}

// The oldest image that is no key; or, when there are too many keys, every other one of the older two thirds.
void vpReferenceHypotheses::makeRoom()
{
  const auto isKey = [](const vpReferenceView &v) { return v.key; };
  const std::size_t keys = static_cast<std::size_t>(std::count_if(m_views.begin(), m_views.end(), isKey));
  if (m_views.size() - keys > mostRecent) {
    m_views.erase(std::find_if_not(m_views.begin(), m_views.end(), isKey));
  }
  if (keys > mostKeys) {
    std::size_t number = 0;
    const auto goes = [&number, &isKey](const vpReferenceView &v) {
      return isKey(v) && ++number % 2 == 0 && number < 2 * mostKeys / 3;
    };
    m_views.erase(std::remove_if(m_views.begin(), m_views.end(), goes), m_views.end());
  }
}

// Both decompositions of the last image's homography, and the one of a camera that has only turned.
void vpReferenceHypotheses::propose()
{
  ++m_proposals;
  try {
    const vpHomography cHr = homographyOf(m_reference, m_views.back());
    std::vector<std::pair<double, double>> points;
    for (const Eigen::Vector2d &p : m_reference) {
      points.emplace_back(p.x(), p.y());
    }
    vpTwoViewDecomposition decomposition;
    for (const vpTwoViewMotion &motion : decomposition.process(cHr, points).candidates) {
      const Eigen::Matrix3d R = matrixOf(motion.c2Rc1).transpose();
      consider(R, -R * Eigen::Vector3d(motion.t[0], motion.t[1], motion.t[2]),
               {motion.normal[0], motion.normal[1], motion.normal[2]});
    }
    const Eigen::Matrix3d H = matrixOf(cHr);
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(std::copysign(1., H.determinant()) * H,
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    consider(svd.matrixV() * svd.matrixU().transpose(), Eigen::Vector3d::Zero(), m_prior.normal);
  }
  catch (const vpException &) { // ViSP's error if the points determine no homography
  }
}

void vpReferenceHypotheses::consider(const Eigen::Matrix3d &R, const Eigen::Vector3d &tau,
                                     const Eigen::Vector3d &normal)
{
  Plane plane;
  plane.h.R = R;
  plane.h.tau = tau;
  plane.h.normal = normal;
  plane.prior = m_prior;
  plane.h.alpha = m_planes.empty() ? m_prior.alpha : m_planes.front().h.alpha;
  if (refine(plane, firstSteps)) {
    m_planes.push_back(plane);
  }
}

bool vpReferenceHypotheses::refine(Plane &plane, int steps)
{
  if (!m_batch.refine(m_views, plane.prior, plane.h, steps)) {
    return false;
  }
  plane.cost = plane.h.cost + plane.past;
  return true;
}

void vpReferenceHypotheses::prune()
{
  std::sort(m_planes.begin(), m_planes.end(), [](const Plane &a, const Plane &b) { return a.cost < b.cost; });
  std::vector<Plane> kept;
  for (const Plane &plane : m_planes) {
    const auto equal = [&plane](const Plane &other) {
      return plane.h.normal.dot(other.h.normal) > std::cos(sameNormal) &&
             vpSO3::log(plane.h.R.transpose() * other.h.R).norm() < sameRotation;
    };
    if (plane.cost <= m_planes.front().cost + unlikely && std::none_of(kept.begin(), kept.end(), equal)) {
      kept.push_back(plane);
    }
  }
  m_planes = std::move(kept);
}

bool vpReferenceHypotheses::fits() const
{
  return !m_planes.empty() &&
         m_planes.front().h.lastCost < worstMisfit * 2. * static_cast<double>(m_views.back().count);
}

double vpReferenceHypotheses::disagreement() const
{
  double largest = 0.;
  for (const Plane &plane : m_planes) {
    largest = std::max(largest, vpSO3::log(best().R.transpose() * plane.h.R).norm());
  }
  return largest;
}

// Of all planes by their likelihoods, about the best.
double vpReferenceHypotheses::alphaVariance() const
{
  double weights = 0., sum = 0.;
  for (const Plane &plane : m_planes) {
    const double weight = std::exp(0.5 * (m_planes.front().cost - plane.cost)),
                 difference = plane.h.alpha - best().alpha;
    weights += weight;
    sum += weight * (plane.h.covariance(8, 8) + difference * difference);
  }
  return sum / weights;
}

double vpReferenceHypotheses::misfit() const
{
  double numbers = 0.;
  for (const vpReferenceView &view : m_views) {
    numbers += 2. * static_cast<double>(view.count);
  }
  return m_planes.front().h.cost / (numbers - 6.); // nine unknowns, three of them known before
}

// Without odometry: what this image adds to the knowledge of the normal.
void vpReferenceHypotheses::learn()
{
  for (Plane &plane : m_planes) {
    if (!m_hasOdometry) {
      plane.prior.normal = plane.h.normal;
      plane.prior.normalInformation = memory * plane.h.covariance.block<2, 2>(6, 6).inverse();
      plane.past = memory * plane.cost;
    }
  }
}

bool vpReferenceHypotheses::onlyTurned() const
{
  return best().tau.norm() < keyMotion && m_prior.alphaWeight * best().covariance(8, 8) > 0.25;
}

END_VISP_NAMESPACE
