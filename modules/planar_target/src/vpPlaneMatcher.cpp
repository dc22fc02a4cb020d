/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/planar_target/vpPlaneMatcher.h>

#include "vpKeypoints.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpPixelMeterConversion.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

BEGIN_VISP_NAMESPACE

namespace
{
//! Derivative of the image of the normalised (x, y) under \e G with respect to the eight elements.
Eigen::Matrix<double, 2, 8> homographyDerivative(const Eigen::Matrix3d &G, double x, double y)
{
  const Eigen::Vector3d X(x, y, 1.), p = G * X;
  const double u = p.x() / p.z(), v = p.y() / p.z();
  Eigen::Matrix<double, 2, 8> J = Eigen::Matrix<double, 2, 8>::Zero();
  J.block<1, 3>(0, 0) = X.transpose();
  J.block<1, 3>(1, 3) = X.transpose();
  J.block<1, 2>(0, 6) = -u * X.head<2>().transpose();
  J.block<1, 2>(1, 6) = -v * X.head<2>().transpose();
  return J / p.z();
}

using Matrix8 = Eigen::Matrix<double, 8, 8>;
using Vector8 = Eigen::Matrix<double, 8, 1>;

struct Normal {
  Matrix8 N = Matrix8::Zero();
  Vector8 b = Vector8::Zero();
  double squares = 0.;
};

// Normal equations of the distances in the frame.
Normal normalEquations(const Eigen::Matrix3d &G, const std::vector<Eigen::Vector2d> &x,
                       const std::vector<cv::Point2f> &to)
{
  Normal sum;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Eigen::Vector3d p = G * x[i].homogeneous();
    const Eigen::Vector2d r(to[i].x - p.x() / p.z(), to[i].y - p.y() / p.z());
    const Eigen::Matrix<double, 2, 8> J = homographyDerivative(G, x[i].x(), x[i].y());
    sum.N += J.transpose() * J;
    sum.b += J.transpose() * r;
    sum.squares += r.squaredNorm();
  }
  return sum;
}

/*!
 * \brief Least-squares homography with its covariance, and the resulting uncertainty of a pixel.
 *
 * Pixels (u, v) of a reference of width x height are normalised to X = ((u - width/2)/S, (v - height/2)/S, 1), S
 * half the width; G maps X to pixels of the frame, G(2,2) = 1, and its other eight elements, row by row, have the
 * covariance C = s^2 (sum J^T J)^-1, s^2 = RSS / (2n - 8).
 */
struct HomographySpread {
  Eigen::Matrix3d G = Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 8, 8> covariance = Eigen::Matrix<double, 8, 8>::Zero();
  double sigma = 0.;  //!< s, px per axis.
  bool known = false; //!< False when the points do not determine a homography (nearly collinear).

  //! \param from, to : At least five pairs, px. \param start : Initial homography of pixels.
  HomographySpread(const std::vector<cv::Point2f> &from, const std::vector<cv::Point2f> &to, const cv::Mat &start,
                   double width, double height);
};

HomographySpread::HomographySpread(const std::vector<cv::Point2f> &from, const std::vector<cv::Point2f> &to,
                                   const cv::Mat &start, double width, double height)
{
  constexpr int iterations = 10;       // quadratic convergence from RANSAC's result
  constexpr double determined = 1e-12; // smallest over largest eigenvalue: below it all digits are lost
  const double S = 0.5 * width;
  Eigen::Matrix3d back; // normalised coordinates to pixels
  back << S, 0., 0.5 * width, 0., S, 0.5 * height, 0., 0., 1.;
  std::vector<Eigen::Vector2d> x;
  for (const cv::Point2f &p : from) {
    x.emplace_back((p.x - 0.5 * width) / S, (p.y - 0.5 * height) / S);
  }
  for (int i = 0; i < 9; ++i) {
    G(i / 3, i % 3) = start.at<double>(i / 3, i % 3);
  }
  G = (G * back).eval();
  G /= G(2, 2);
  Normal normal = normalEquations(G, x, to);
  for (int i = 0; i < iterations; ++i) {
    const Vector8 step = normal.N.ldlt().solve(normal.b);
    Eigen::Matrix3d next = G;
    for (int k = 0; k < 8; ++k) {
      next(k / 3, k % 3) += step(k);
    }
    const Normal after = normalEquations(next, x, to);
    if (!(after.squares <= normal.squares)) {
      break;
    }
    const bool done = after.squares > (1. - 1e-9) * normal.squares;
    G = next;
    normal = after;
    if (done) {
      break;
    }
  }
  const Eigen::SelfAdjointEigenSolver<Matrix8> solver(normal.N);
  known = G.allFinite() && normal.N.allFinite() &&
          solver.eigenvalues().minCoeff() > determined * solver.eigenvalues().maxCoeff();
  if (known) {
    const double s2 = normal.squares / (2. * static_cast<double>(x.size()) - 8.);
    sigma = std::sqrt(s2);
    covariance = s2 * solver.eigenvectors() * solver.eigenvalues().cwiseInverse().asDiagonal() *
                 solver.eigenvectors().transpose();
  }
}
} // namespace

class vpPlaneMatcher::Impl
{
public:
  Impl(const vpImage<unsigned char> &reference, const vpPlanarTargetSpec &spec) : m_spec(spec)
  {
    spec.validate();
    if (reference.getWidth() < smallestImage || reference.getHeight() < smallestImage) {
      throw vpException(vpException::dimensionError, "reference image is %ux%u px, must be at least %ux%u",
                        reference.getWidth(), reference.getHeight(), smallestImage, smallestImage);
    }
    m_extractor = makeKeypointExtractor(spec.keypoints, spec);
    m_extractor->extract(pixelsOf(reference), m_reference);
    if (m_reference.points.size() < spec.minInliers) {
      throw vpException(
          vpException::badValue, "reference image has too little texture: %u %s keypoints, at least %u are needed",
          static_cast<unsigned int>(m_reference.points.size()), vpToString(spec.keypoints), spec.minInliers);
    }
    m_width = reference.getWidth();
    m_height = reference.getHeight();
    begin();
  }

  void match(const vpImage<unsigned char> &image)
  {
    begin();
    if (image.getWidth() < smallestImage || image.getHeight() < smallestImage) {
      fail(vpPlanarTargetStatus::NoTexture, "The image is " + std::to_string(image.getWidth()) + "x" +
                                                std::to_string(image.getHeight()) + " px, at least 32x32 are needed.");
      return;
    }
    m_extractor->extract(pixelsOf(image), m_current);
    m_result.frameKeypoints = m_current.points.size();
    if (m_current.points.size() < m_spec.minInliers) {
      fail(vpPlanarTargetStatus::NoTexture, "The image has " + std::to_string(m_current.points.size()) +
                                                " keypoints, at least " + std::to_string(m_spec.minInliers) +
                                                " are needed.");
      return;
    }
    std::vector<cv::Point2f> from, to;
    for (const auto &pair : matchKeypoints(m_reference, m_current)) {
      from.push_back(m_reference.points[static_cast<std::size_t>(pair.first)]);
      to.push_back(m_current.points[static_cast<std::size_t>(pair.second)]);
    }
    m_result.matches = from.size();
    std::vector<unsigned char> mask;
    std::vector<cv::Point2f> inlierFrom, inlierTo;
    cv::Mat H;
    if (from.size() >= m_spec.minInliers) {
      H = cv::findHomography(from, to, cv::USAC_MAGSAC, m_spec.inlierThreshold, mask, 5000, 0.999);
    }
    for (std::size_t i = 0; !H.empty() && i < from.size(); ++i) {
      if (mask[i]) {
        inlierFrom.push_back(from[i]);
        inlierTo.push_back(to[i]);
        m_result.inliers.emplace_back(vpImagePoint(from[i].y, from[i].x), vpImagePoint(to[i].y, to[i].x));
      }
    }
    if (m_result.inliers.size() < m_spec.minInliers) {
      fail(vpPlanarTargetStatus::TooFewInliers,
           std::to_string(m_result.inliers.size()) + " of " + std::to_string(from.size()) +
               " matches agree on one plane, at least " + std::to_string(m_spec.minInliers) + " must.");
      return;
    }
    conclude(HomographySpread(inlierFrom, inlierTo, H, m_width, m_height), cv::boundingRect(inlierFrom));
  }

  vpPlaneMatch m_result;

private:
  void begin()
  {
    m_result = vpPlaneMatch();
    m_result.referenceKeypoints = m_reference.points.size();
    m_result.referenceWidth = m_width;
    m_result.referenceHeight = m_height;
  }

  void conclude(const HomographySpread &spread, const cv::Rect &box)
  {
    Eigen::Matrix3d toNormalised;
    toNormalised << 2. / m_width, 0., -1., 0., 2. / m_width, -1. * m_height / m_width, 0., 0., 1.;
    Eigen::Matrix3d H = spread.G * toNormalised;
    H /= H(2, 2);
    for (int i = 0; i < 9; ++i) {
      m_result.homography[static_cast<std::size_t>(i)] = H(i / 3, i % 3);
    }
    m_result.status = vpPlanarTargetStatus::Extrapolated; // also when the inliers do not determine it
    m_result.sigma = spread.sigma;
    for (int i = 0; i < 64; ++i) {
      m_result.covariance[static_cast<std::size_t>(i)] =
          spread.known ? spread.covariance(i / 8, i % 8) : std::numeric_limits<double>::infinity();
    }
    for (const double v : {0., m_height - 1.}) {
      for (const double u : {0., m_width - 1.}) {
        m_result.cornerDeviation = std::max(m_result.cornerDeviation, m_result.deviation(vpImagePoint(v, u)));
      }
    }
    m_result.message =
        std::to_string(m_result.inliers.size()) + " of " + std::to_string(m_result.matches) + " matches agree.";
    if (m_result.cornerDeviation <= 3. * m_spec.inlierThreshold) {
      m_result.status = vpPlanarTargetStatus::Acquired;
      return;
    }
    char text[200];
    std::snprintf(
        text, sizeof(text),
        " They lie within %d x %d of %u x %u px; a corner of the image is uncertain by %.3g px, at most %.3g may be.",
        box.width, box.height, m_width, m_height, m_result.cornerDeviation, 3. * m_spec.inlierThreshold);
    m_result.message += text;
  }

  void fail(vpPlanarTargetStatus status, const std::string &message)
  {
    m_result.status = status;
    m_result.message = message;
  }

  vpPlanarTargetSpec m_spec;
  unsigned int m_width = 0, m_height = 0; // of the reference
  std::unique_ptr<vpKeypointExtractor> m_extractor;
  vpKeypointSet m_reference, m_current;
};

vpPlaneMatcher::vpPlaneMatcher(const vpImage<unsigned char> &reference, const vpPlanarTargetSpec &spec)
  : m_impl(std::make_unique<Impl>(reference, spec))
{}

vpPlaneMatcher::~vpPlaneMatcher() = default;
vpPlaneMatcher::vpPlaneMatcher(vpPlaneMatcher &&) noexcept = default;
vpPlaneMatcher &vpPlaneMatcher::operator=(vpPlaneMatcher &&) noexcept = default;

const vpPlaneMatch &vpPlaneMatcher::match(const vpImage<unsigned char> &image)
{
  m_impl->match(image);
  return m_impl->m_result;
}

const vpPlaneMatch &vpPlaneMatcher::result() const { return m_impl->m_result; }

double vpPlaneMatch::deviation(const vpImagePoint &reference) const
{
  if (!hasHomography()) {
    return std::numeric_limits<double>::infinity();
  }
  const double S = 0.5 * referenceWidth;
  Eigen::Matrix3d H, back;
  for (int i = 0; i < 9; ++i) {
    H(i / 3, i % 3) = homography[static_cast<std::size_t>(i)];
  }
  back << S, 0., S, 0., S, 0.5 * referenceHeight, 0., 0., 1.;
  Eigen::Matrix3d G = H * back;
  G /= G(2, 2);
  const Eigen::Map<const Eigen::Matrix<double, 8, 8>> C(covariance.data()); // symmetric
  const auto J = homographyDerivative(G, (reference.get_u() - S) / S, (reference.get_v() - 0.5 * referenceHeight) / S);
  const double variance = (J * C * J.transpose()).trace();
  return variance >= 0. ? std::sqrt(variance) : std::numeric_limits<double>::infinity();
}

vpHomography vpPlaneMatch::euclidean(const vpCameraParameters &camera) const
{
  vpHomography H;
  for (unsigned int i = 0; i < 9; ++i) {
    H[i / 3][i % 3] = homography[i];
  }
  return H.collineation2homography(camera);
}

std::vector<std::pair<double, double>> vpPlaneMatch::referencePoints(const vpCameraParameters &camera) const
{
  std::vector<std::pair<double, double>> points(inliers.size());
  std::transform(inliers.begin(), inliers.end(), points.begin(), [&camera](const auto &pair) {
    std::pair<double, double> p;
    vpPixelMeterConversion::convertPoint(camera, pair.first, p.first, p.second);
    return p;
  });
  return points;
}

END_VISP_NAMESPACE
