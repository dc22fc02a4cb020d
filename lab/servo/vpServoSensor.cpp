/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/servo/vpServoSensor.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpGaussRand.h>
#include <visp3/core/vpImage.h>
#include <visp3/core/vpMeterPixelConversion.h>
#include <visp3/core/vpPoint.h>
#include <visp3/core/vpUniRand.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/planar_target/vpPlanarTarget.h>
#include <visp3/vision/vpHomography.h>
#include <visp3/vision/vpPose.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <utility>

BEGIN_VISP_NAMESPACE

vpServoSensor::vpServoSensor(const vpServoTask &task, std::vector<Eigen::Vector3d> points)
  : m_task(task), m_target(std::move(points), vpServoTarget::rectangle(task.objectWidth, task.objectHeight).points())
{}

void vpServoSensor::measure(const vpHomogeneousMatrix &cMo, double time, vpServoMeasurement &result)
{
  result.time = time;
  result.covariance = vpPoseCovariance();
  result.valid = look(cMo, result);
  if (result.valid) {
    vpServoTarget::project(m_target.outline(), result.cMo, result.outline);
  }
}

bool vpServoSensor::inPicture(double x, double y) const
{
  double u = 0., v = 0.;
  vpMeterPixelConversion::convertPoint(m_task.camera, x, y, u, v);
  return u >= 0. && v >= 0. && u <= m_task.width - 1. && v <= m_task.height - 1.;
}

namespace
{
// The points belong to the object, not to the experiment: they must not depend on the seed.
constexpr unsigned int objectSeed = 5;
constexpr unsigned int fewestPoints = 4;
// Points closer to a line than this fraction of the object's size (standard deviation) leave the tilt about it unknown.
constexpr double smallestSpread = 0.05;

// Pose of the plane z = 0 from its homography to normalised image coordinates: H ~ [r1 r2 t], positive depth.
vpHomogeneousMatrix poseFromHomography(const vpHomography &H)
{
  Eigen::Matrix3d M;
  for (unsigned int r = 0; r < 3; ++r) {
    for (unsigned int c = 0; c < 3; ++c) {
      M(r, c) = H[r][c];
    }
  }
  M /= std::copysign(0.5 * (M.col(0).norm() + M.col(1).norm()), M(2, 2));
  Eigen::Matrix3d axes;
  axes << M.col(0), M.col(1), M.col(0).cross(M.col(1));
  // With noise the axes are not exactly orthonormal: use the nearest rotation.
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d R = svd.matrixU() * svd.matrixV().transpose();
  vpHomogeneousMatrix cMo;
  for (unsigned int r = 0; r < 3; ++r) {
    for (unsigned int c = 0; c < 3; ++c) {
      cMo[r][c] = R(r, c);
    }
    cMo[r][3] = M(r, 2);
  }
  return cMo;
}

// Standard deviation of the points perpendicular to their best-fit line.
double spreadAcrossLine(const std::vector<double> &X, const std::vector<double> &Y)
{
  const Eigen::Map<const Eigen::ArrayXd> x(X.data(), X.size()), y(Y.data(), Y.size());
  const Eigen::ArrayXd dx = x - x.mean(), dy = y - y.mean();
  const double xx = (dx * dx).mean(), yy = (dy * dy).mean(), xy = (dx * dy).mean();
  return std::sqrt(std::max(0., 0.5 * (xx + yy - std::hypot(xx - yy, 2. * xy)))); // smaller eigenvalue
}

class vpPointSensor : public vpServoSensor
{
public:
  vpPointSensor(const vpServoTask &task, double pixelNoise, unsigned int seed)
    : vpServoSensor(task, randomPoints(task)), m_pixelNoise(pixelNoise), m_noise(pixelNoise, 0., seed)
  {}

protected:
  bool look(const vpHomogeneousMatrix &cMo, vpServoMeasurement &result) VP_OVERRIDE
  {
    vpServoTarget::project(m_target.points(), cMo, result.points);
    for (vpServoPoint &p : result.points) {
      // Drawn for hidden points, too: the noise of later frames must not depend on the visibility in this one.
      const double du = m_noise(), dv = m_noise();
      p.x += du / m_task.camera.get_px();
      p.y += dv / m_task.camera.get_py();
      p.visible = p.visible && inPicture(p.x, p.y);
    }
    if (!estimatePose(result) || !takeDepths(result)) {
      return false;
    }
    takeCovariance(result);
    return true;
  }

private:
  static std::vector<Eigen::Vector3d> randomPoints(const vpServoTask &task)
  {
    vpUniRand random(objectSeed);
    std::vector<Eigen::Vector3d> points(task.pointCount, Eigen::Vector3d::Zero());
    for (Eigen::Vector3d &p : points) {
      p.x() = random.uniform(-0.5, 0.5) * task.objectWidth;
      p.y() = random.uniform(-0.5, 0.5) * task.objectHeight;
    }
    return points;
  }

  bool estimatePose(vpServoMeasurement &result) const
  {
    std::vector<double> X, Y, x, y;
    std::vector<vpPoint> points;
    const std::vector<Eigen::Vector3d> &features = m_target.points();
    for (std::size_t i = 0; i < features.size(); ++i) {
      if (!result.points[i].visible) {
        continue;
      }
      X.push_back(features[i].x());
      Y.push_back(features[i].y());
      x.push_back(result.points[i].x);
      y.push_back(result.points[i].y);
      points.emplace_back(X.back(), Y.back(), 0.);
      points.back().set_x(x.back());
      points.back().set_y(y.back());
    }
    if (points.size() < fewestPoints ||
        spreadAcrossLine(X, Y) < smallestSpread * std::min(m_task.objectWidth, m_task.objectHeight)) {
      return false;
    }
    try {
      vpHomography H;
      vpHomography::DLT(X, Y, x, y, H, true);
      result.cMo = poseFromHomography(H);
      vpPose pose(points);
      pose.setVvsEpsilon(1e-10); // of the summed squares; the noise alone makes 1e-5
      pose.poseVirtualVS(result.cMo);
      return pose.computeResidual(result.cMo) < largestResidual() * largestResidual() * 2. * points.size();
    }
    catch (const vpException &) { // ViSP's error if these few points determine no homography
      return false;
    }
  }

  // Beyond any noise: the refinement diverged. Normalised, per coordinate, root mean square.
  double largestResidual() const { return (3. * m_pixelNoise + 1.) / m_task.camera.get_px(); }

  bool takeDepths(vpServoMeasurement &result) const
  {
    for (std::size_t i = 0; i < result.points.size(); ++i) {
      const Eigen::Vector3d &feature = m_target.points()[i];
      vpServoPoint &p = result.points[i];
      p.Z = result.cMo[2][0] * feature.x() + result.cMo[2][1] * feature.y() + result.cMo[2][3];
      if (p.visible && !(p.Z > 0.)) {
        return false;
      }
    }
    return true;
  }

  // Covariance of the least-squares pose: (sum J^T J / sigma^2)^-1, J the derivatives of the visible points' images by
  // (v, w), with which a point P of the object moves by v + w x (P - t).
  void takeCovariance(vpServoMeasurement &result) const
  {
    using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
    const Eigen::Vector3d t(result.cMo[0][3], result.cMo[1][3], result.cMo[2][3]);
    Matrix6 information = Matrix6::Zero();
    for (const vpServoPoint &p : result.points) {
      if (!p.visible) {
        continue;
      }
      Eigen::Matrix<double, 2, 3> image;
      image << m_task.camera.get_px(), 0., -m_task.camera.get_px() * p.x, //
          0., m_task.camera.get_py(), -m_task.camera.get_py() * p.y;
      Eigen::Matrix<double, 2, 6> J;
      J << image / p.Z, -(image / p.Z) * vpSO3::skew(p.Z * Eigen::Vector3d(p.x, p.y, 1.) - t);
      information += J.transpose() * J;
    }
    const Eigen::LDLT<Matrix6> solver(information);
    if (solver.info() == Eigen::Success && solver.isPositive() && solver.rcond() > 1e-12) {
      Eigen::Map<Matrix6>(result.covariance.C.data()) = m_pixelNoise * m_pixelNoise * solver.solve(Matrix6::Identity());
      result.covariance.known = true;
    }
  }

  double m_pixelNoise;
  vpGaussRand m_noise;
};
} // namespace

std::unique_ptr<vpServoSensor> vpServoSensor::points(const vpServoTask &task, double pixelNoise, unsigned int seed)
{
  return std::make_unique<vpPointSensor>(task, pixelNoise, seed);
}

namespace
{
vpImage<unsigned char> readPhoto(const std::string &file)
{
  vpImage<unsigned char> photo;
  vpImageIo::read(photo, file);
  return photo;
}

class vpImageSensor : public vpServoSensor
{
public:
  vpImageSensor(const vpServoTask &task, const vpImage<unsigned char> &photo, const vpCameraFaults &faults,
                unsigned int seed)
    : vpServoSensor(task, gridPoints(task)),
      m_renderer(photo, task.objectWidth, task.objectHeight, task.camera, task.width, task.height),
      m_tracker(photo, task.objectWidth, task.objectHeight, task.camera), m_faults(faults), m_seed(seed)
  {}

protected:
  bool look(const vpHomogeneousMatrix &cMo, vpServoMeasurement &result) VP_OVERRIDE
  {
    m_renderer.render(cMo, m_faults, m_seed++, m_image);
    m_target.measure(m_tracker.process(m_image), result.time, result);
    for (vpServoPoint &p : result.points) {
      p.visible = p.visible && inPicture(p.x, p.y);
    }
    return result.valid;
  }

private:
  // The most nearly square grid with at least pointCount nodes; its last row may be incomplete.
  static std::vector<Eigen::Vector3d> gridPoints(const vpServoTask &task)
  {
    const unsigned int columns = static_cast<unsigned int>(std::ceil(std::sqrt(task.pointCount)));
    const unsigned int rows = (task.pointCount + columns - 1) / columns;
    std::vector<Eigen::Vector3d> points;
    for (unsigned int i = 0; i < task.pointCount; ++i) {
      const unsigned int row = i / columns;
      const unsigned int column = i % columns;
      points.emplace_back(((column + 0.5) / columns - 0.5) * task.objectWidth,
                          ((row + 0.5) / rows - 0.5) * task.objectHeight, 0.);
    }
    return points;
  }

  vpPlaneRenderer m_renderer;
  vpPlanarTarget m_tracker;
  vpCameraFaults m_faults;
  unsigned int m_seed; // changes with every frame
  vpImage<unsigned char> m_image;
};
} // namespace

std::unique_ptr<vpServoSensor> vpServoSensor::image(const vpServoTask &task, const std::string &photo,
                                                    const vpCameraFaults &faults, unsigned int seed)
{
  return std::make_unique<vpImageSensor>(task, readPhoto(photo), faults, seed);
}

END_VISP_NAMESPACE
