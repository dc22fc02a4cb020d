/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/planar_target/vpTwoViewDecomposition.h>

#include <visp3/core/vpException.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <list>

BEGIN_VISP_NAMESPACE

namespace
{
double angleBetween(const vpColVector &a, const vpColVector &b)
{
  const Eigen::Vector3d u(a[0], a[1], a[2]), v(b[0], b[1], b[2]);
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

bool inFront(const vpColVector &normal, const std::vector<std::pair<double, double>> &points)
{
  return std::all_of(points.begin(), points.end(), [&](const std::pair<double, double> &p) {
    return normal[0] * p.first + normal[1] * p.second + normal[2] > 0.;
  });
}

// t / d = (H - R) n, (4.29). ViSP 3.5 gives zero when two singular values are equal, as for a motion along the normal.
vpTranslationVector translation(const vpHomography &H, const vpRotationMatrix &R, const vpColVector &n)
{
  vpTranslationVector t;
  for (unsigned int r = 0; r < 3; ++r) {
    t[r] = 0.;
    for (unsigned int c = 0; c < 3; ++c) {
      t[r] += (H[r][c] - R[r][c]) * n[c];
    }
  }
  return t;
}

double determinant(const vpHomography &H)
{
  Eigen::Matrix3d M;
  for (unsigned int i = 0; i < 9; ++i) {
    M(i / 3, i % 3) = H[i / 3][i % 3];
  }
  return M.determinant();
}

std::string degrees(double angle)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f deg", angle * 180. / M_PI);
  return text;
}

std::string notFinite(const std::vector<std::pair<double, double>> &points)
{
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].first) || !std::isfinite(points[i].second)) {
      char text[120];
      std::snprintf(text, sizeof(text), "Point %zu of the plane is (%g, %g), must be finite.", i, points[i].first,
                    points[i].second);
      return text;
    }
  }
  return "";
}

// Scaled to sigma2 = 1 and to positive depth of the point (x, y) in the current view; false when that is impossible.
bool normalise(const vpHomography &H, double x, double y, vpHomography &scaled, Eigen::Vector3d &sigma)
{
  Eigen::Matrix3d M;
  for (unsigned int r = 0; r < 3; ++r) {
    for (unsigned int c = 0; c < 3; ++c) {
      M(r, c) = H[r][c];
    }
  }
  if (!M.allFinite()) {
    return false;
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(M.transpose() * M, Eigen::EigenvaluesOnly);
  sigma = solver.eigenvalues().cwiseMax(0.).cwiseSqrt().reverse();
  if (!(sigma[2] > 1e-6 * sigma[0])) {
    return false;
  }
  const double scale = std::copysign(1. / sigma[1], M.row(2).dot(Eigen::Vector3d(x, y, 1.)));
  sigma /= sigma[1];
  for (unsigned int r = 0; r < 3; ++r) {
    for (unsigned int c = 0; c < 3; ++c) {
      scaled[r][c] = scale * M(r, c);
    }
  }
  return true;
}
} // namespace

const char *vpToString(vpTwoViewStatus status)
{
  switch (status) {
  case vpTwoViewStatus::Unique:
    return "Unique";
  case vpTwoViewStatus::Ambiguous:
    return "Ambiguous";
  case vpTwoViewStatus::PureRotation:
    return "PureRotation";
  case vpTwoViewStatus::Invalid:
    return "Invalid";
  }
  return "unknown";
}

void vpTwoViewSpec::validate() const
{
  if (!(minTranslation > 0.) || !std::isfinite(minTranslation)) {
    throw vpException(vpException::badValue,
                      "minTranslation of the two-view decomposition is %g, must be finite and > 0", minTranslation);
  }
  if (!(normalTolerance > 0. && normalTolerance <= 0.5)) {
    throw vpException(vpException::badValue,
                      "normalTolerance of the two-view decomposition is %g rad, must be in (0, 0.5]", normalTolerance);
  }
}

vpTwoViewDecomposition::vpTwoViewDecomposition(const vpTwoViewSpec &spec) : m_spec(spec) { spec.validate(); }

void vpTwoViewDecomposition::setNormalPrior(const vpColVector &normal)
{
  if (normal.getRows() != 3) {
    throw vpException(vpException::badValue, "the normal prior has %u components, must have 3", normal.getRows());
  }
  const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  if (!(length > 0.) || !std::isfinite(length)) {
    throw vpException(vpException::badValue, "the normal prior is (%g, %g, %g), must be finite and not zero", normal[0],
                      normal[1], normal[2]);
  }
  m_hypotheses = {normal / length};
  m_hasPrior = true;
}

void vpTwoViewDecomposition::reset()
{
  m_hypotheses.clear();
  m_hasPrior = false;
  m_result = vpTwoViewResult();
}

void vpTwoViewDecomposition::conclude(vpTwoViewStatus status, const std::string &message)
{
  m_result.status = status;
  m_result.message = message;
}

const vpTwoViewResult &vpTwoViewDecomposition::process(const vpHomography &c2Hc1,
                                                       const std::vector<std::pair<double, double>> &points)
{
  m_result = vpTwoViewResult();
  vpHomography H;
  Eigen::Vector3d sigma;
  const std::string badPoint = notFinite(points);
  if (!badPoint.empty()) {
    conclude(vpTwoViewStatus::Invalid, badPoint);
    return m_result;
  }
  if (points.empty() || !normalise(c2Hc1, points[0].first, points[0].second, H, sigma)) {
    conclude(vpTwoViewStatus::Invalid, points.empty() ? "No point of the plane is given, at least one is needed."
                                                      : "The homography is singular or not finite.");
    return m_result;
  }
  // det(R + t n^T / d) is the distance of the second camera from the plane over that of the first, on the same side.
  if (!(determinant(H) > 0.)) {
    conclude(vpTwoViewStatus::Invalid,
             "The homography is mirrored: no motion of a camera before an opaque plane does that.");
    return m_result;
  }
  const double moved = sigma[0] - sigma[2]; // = |t| / d
  if (moved < m_spec.minTranslation) {
    char text[160];
    std::snprintf(text, sizeof(text),
                  "The camera moved by %.4f of the plane's distance, at least %.4f are needed: it only turned.", moved,
                  m_spec.minTranslation);
    conclude(vpTwoViewStatus::PureRotation, text);
    return m_result;
  }
  // A point of the plane decides the sign of each pair; the others then confirm it.
  std::list<vpRotationMatrix> rotations;
  std::list<vpTranslationVector> translations;
  std::list<vpColVector> normals;
  vpHomography::computeDisplacement(H, points[0].first, points[0].second, rotations, translations, normals);
  auto n = normals.begin();
  for (auto R = rotations.begin(); R != rotations.end(); ++R, ++n) {
    if (inFront(*n, points)) {
      m_result.candidates.push_back({*R, translation(H, *R, *n), *n});
    }
  }
  choose();
  return m_result;
}

void vpTwoViewDecomposition::choose()
{
  std::vector<vpTwoViewMotion> &candidates = m_result.candidates;
  if (candidates.empty()) {
    conclude(vpTwoViewStatus::Invalid, "No motion has all points in front of the reference camera.");
    return;
  }
  // Translation along the normal: both planes coincide.
  if (candidates.size() == 2 && angleBetween(candidates[0].normal, candidates[1].normal) < 1e-3) {
    candidates.pop_back();
  }
  if (m_hasPrior) {
    chooseByPrior();
  }
  else if (candidates.size() == 1) {
    m_result.best = candidates[0];
    m_hypotheses = {candidates[0].normal};
    conclude(vpTwoViewStatus::Unique, "One motion has all points in front of the camera.");
  }
  else {
    chooseByHistory();
  }
}

void vpTwoViewDecomposition::chooseByPrior()
{
  std::vector<vpTwoViewMotion> &candidates = m_result.candidates;
  std::sort(candidates.begin(), candidates.end(), [this](const vpTwoViewMotion &a, const vpTwoViewMotion &b) {
    return angleBetween(a.normal, m_hypotheses[0]) < angleBetween(b.normal, m_hypotheses[0]);
  });
  const double nearest = angleBetween(candidates[0].normal, m_hypotheses[0]);
  const double rival = candidates.size() == 2 ? angleBetween(candidates[1].normal, m_hypotheses[0]) : M_PI;
  if (rival - nearest < m_spec.normalTolerance) {
    conclude(vpTwoViewStatus::Ambiguous,
             "Both planes are about as far from the prior, " + degrees(nearest) + " and " + degrees(rival) + ".");
    return;
  }
  m_result.best = candidates[0];
  conclude(vpTwoViewStatus::Unique, "The plane nearest to the prior was taken, " + degrees(nearest) + " from it.");
}

void vpTwoViewDecomposition::chooseByHistory()
{
  const std::vector<vpTwoViewMotion> &candidates = m_result.candidates;
  const auto nearest = [&candidates](const vpColVector &normal) {
    return *std::min_element(candidates.begin(), candidates.end(),
                             [&](const vpTwoViewMotion &a, const vpTwoViewMotion &b) {
                               return angleBetween(a.normal, normal) < angleBetween(b.normal, normal);
                             });
  };
  const auto refuted = [&](const vpColVector &normal) {
    return angleBetween(nearest(normal).normal, normal) > m_spec.normalTolerance;
  };
  m_hypotheses.erase(std::remove_if(m_hypotheses.begin(), m_hypotheses.end(), refuted), m_hypotheses.end());
  if (m_hypotheses.size() == 1) {
    m_result.best = nearest(m_hypotheses[0]);
    conclude(vpTwoViewStatus::Unique, "One plane explains all frames so far.");
    return;
  }
  if (m_hypotheses.empty()) { // the first frame, or the reference changed unnoticed: restart
    for (const vpTwoViewMotion &candidate : candidates) {
      m_hypotheses.push_back(candidate.normal);
    }
  }
  conclude(vpTwoViewStatus::Ambiguous, "Two planes explain all frames so far, " +
                                           degrees(angleBetween(m_hypotheses[0], m_hypotheses[1])) +
                                           " apart; another motion will tell.");
}

END_VISP_NAMESPACE
