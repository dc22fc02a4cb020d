/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpReferenceBatch.h"

#include <visp3/direct_core/vpSO3.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double steepest = 0.05; // smallest n . m of a reference point: the plane is seen from the front
constexpr double nearest = 0.02;  // smallest depth, in units of the plane's distance
constexpr double enough = 1e-3;   // decrease of the cost below which the steps end: 3 % of a standard deviation
} // namespace

Eigen::Matrix<double, 3, 2> vpReferenceBatch::tangent(const Eigen::Vector3d &normal)
{
  Eigen::Matrix<double, 3, 2> B;
  B.col(0) =
      normal.cross(std::abs(normal.x()) < 0.7 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY()).normalized();
  B.col(1) = normal.cross(B.col(0));
  return B;
}

vpReferenceBatch::vpReferenceBatch(const std::vector<Eigen::Vector2d> &reference, double sigma)
  : m_reference(reference), m_weight(1. / (sigma * sigma))
{
  m_now.points.resize(reference.size());
  m_next.points.resize(reference.size());
}

/*
 * Point i of the plane is at X = m / (n . m), m = (reference + noise, 1), and in view k at Y = Ro^T (Z - alpha po), Z =
 * R^T (X - tau). With J the derivative of the image by Y, all nine derivatives are J Ro^T (-R^T, [Z]x, R^T dX/dn, -po):
 * S, Sp and spp sum w Ro J^T J Ro^T with none, one and both of its sides multiplied by po.
 */
bool vpReferenceBatch::addPoint(std::size_t i, const vpReferenceHypothesis &h, const Eigen::Matrix<double, 3, 2> &B,
                                Normal &normal) const
{
  const Eigen::Vector2d &noise = h.noise[i];
  const Eigen::Vector3d m = (m_reference[i] + noise).homogeneous();
  const double q = h.normal.dot(m);
  if (!(q > steepest)) {
    return false;
  }
  const Eigen::Vector3d X = m / q, Z = h.R.transpose() * (X - h.tau);
  Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
  Eigen::Vector3d Sp = Eigen::Vector3d::Zero(), s = Eigen::Vector3d::Zero();
  double spp = 0., sp = 0.;
  for (std::size_t k = 0; k < m_cameras.size(); ++k) {
    const vpReferenceView &view = (*m_views)[k];
    if (!view.visible[i]) {
      continue;
    }
    const Camera &camera = m_cameras[k];
    const Eigen::Vector3d Y = camera.R.transpose() * (Z - h.alpha * camera.p);
    if (!(Y.z() > nearest)) {
      return false;
    }
    const double x = Y.x() / Y.z(), y = Y.y() / Y.z();
    const Eigen::Vector2d r(view.points[i].x() - x, view.points[i].y() - y);
    Eigen::Matrix<double, 2, 3> J; // times Ro^T
    J.row(0) = (camera.R.col(0) - x * camera.R.col(2)).transpose() / Y.z();
    J.row(1) = (camera.R.col(1) - y * camera.R.col(2)).transpose() / Y.z();
    const Eigen::Vector2d Jp = J * camera.p;
    const Eigen::Matrix<double, 3, 2> Jw = view.weight * J.transpose();
    S.noalias() += Jw * J;
    Sp.noalias() += Jw * Jp;
    s.noalias() += Jw * r;
    spp += view.weight * Jp.squaredNorm();
    sp += view.weight * Jp.dot(r);
    const double cost = view.weight * r.squaredNorm();
    normal.cost += cost;
    normal.lastCost += k + 1 == m_cameras.size() ? cost : 0.;
  }
  const Eigen::Matrix3d Rt = h.R.transpose();
  Eigen::Matrix<double, 3, 8> M;
  M << -Rt, vpSO3::skew(Z), Rt * (-m * (m.transpose() * B)) / (q * q);
  const Eigen::Matrix<double, 3, 2> N = (Rt / q - (Rt * m) * h.normal.transpose() / (q * q)).leftCols<2>();
  const Eigen::Matrix<double, 3, 8> SM = S * M;
  normal.A.topLeftCorner<8, 8>() += M.transpose() * SM;
  normal.A.topRightCorner<8, 1>() -= M.transpose() * Sp;
  normal.A(8, 8) += spp;
  normal.b.head<8>() += M.transpose() * s;
  normal.b(8) -= sp;
  normal.cost += m_weight * noise.squaredNorm();

  Point &point = normal.points[i];
  point.inverse = (N.transpose() * S * N + m_weight * Eigen::Matrix2d::Identity()).inverse();
  point.link << SM.transpose() * N, -Sp.transpose() * N;
  point.right = N.transpose() * s - m_weight * noise;
  const Eigen::Matrix<double, 9, 2> reduced = point.link * point.inverse;
  normal.A -= reduced * point.link.transpose();
  normal.b -= reduced * point.right;
  normal.noiseGain += point.right.dot(point.inverse * point.right);
  return true;
}

// Normal equations without the reference points' noise.
bool vpReferenceBatch::linearise(const vpReferenceHypothesis &h, const vpReferencePrior &prior, Normal &normal) const
{
  normal.A.setZero();
  normal.b.setZero();
  normal.noiseGain = normal.lastCost = 0.;
  const double alphaError = prior.alpha - h.alpha;
  normal.A(8, 8) = prior.alphaWeight;
  normal.b(8) = prior.alphaWeight * alphaError;
  normal.cost = prior.alphaWeight * alphaError * alphaError;
  const Eigen::Matrix<double, 3, 2> B = tangent(h.normal), B0 = tangent(prior.normal);
  const Eigen::Vector2d across = B0.transpose() * h.normal;
  const double sine = across.norm(), angle = std::atan2(sine, h.normal.dot(prior.normal));
  const Eigen::Vector2d tilt = sine > 1e-9 ? Eigen::Vector2d(across * (angle / sine)) : across;
  const Eigen::Matrix2d turn = B0.transpose() * B;
  normal.A.block<2, 2>(6, 6) = turn.transpose() * prior.normalInformation * turn;
  normal.b.segment<2>(6) = -turn.transpose() * prior.normalInformation * tilt;
  normal.cost += tilt.dot(prior.normalInformation * tilt);
  for (std::size_t i = 0; i < m_reference.size(); ++i) {
    if (!addPoint(i, h, B, normal)) {
      return false;
    }
  }
  normal.A.bottomLeftCorner<1, 8>() = normal.A.topRightCorner<8, 1>().transpose();
  return std::isfinite(normal.cost) && normal.A.allFinite() && normal.b.allFinite();
}

void vpReferenceBatch::move(const Normal &normal, const Vector9 &step, vpReferenceHypothesis &h) const
{
  h.normal = (h.normal + tangent(h.normal) * step.segment<2>(6)).normalized();
  h.tau += step.head<3>();
  h.R = Eigen::Quaterniond(h.R * vpSO3::exp(step.segment<3>(3))).normalized().toRotationMatrix();
  h.alpha += step(8);
  for (std::size_t i = 0; i < h.noise.size(); ++i) {
    const Point &point = normal.points[i];
    h.noise[i] += point.inverse * (point.right - point.link.transpose() * step);
  }
}

bool vpReferenceBatch::refine(const std::vector<vpReferenceView> &views, const vpReferencePrior &prior,
                              vpReferenceHypothesis &h, int iterations)
{
  m_views = &views;
  m_cameras.clear();
  const vpRigidTransform lMf = views.back().fMc.inverse();
  for (const vpReferenceView &view : views) {
    const vpRigidTransform lMc = lMf * view.fMc;
    m_cameras.push_back({lMc.R, lMc.p});
  }
  h.noise.resize(m_reference.size(), Eigen::Vector2d::Zero());
  if (!linearise(h, prior, m_now)) {
    return false;
  }
  double damping = 1e-6;
  for (int k = 0; k < iterations; ++k) {
    Matrix9 A = m_now.A;
    A.diagonal() *= 1. + damping;
    const Vector9 step = A.ldlt().solve(m_now.b);
    if (!step.allFinite()) {
      return false;
    }
    if (step.dot(m_now.b) + m_now.noiseGain < enough) {
      break;
    }
    vpReferenceHypothesis next = h;
    move(m_now, step, next);
    if (linearise(next, prior, m_next) && m_next.cost < m_now.cost) {
      h = std::move(next);
      std::swap(m_now, m_next);
      damping *= 0.1;
    }
    else {
      damping = 10. * std::max(damping, 1e-4);
    }
  }
  h.cost = m_now.cost;
  h.lastCost = m_now.lastCost;
  h.covariance = m_now.A.inverse();
  return h.covariance.allFinite() && (h.covariance.diagonal().array() > 0.).all();
}

END_VISP_NAMESPACE
