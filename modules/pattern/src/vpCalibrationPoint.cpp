/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFieldCheck.h"

#include "vpCalibrationInput.h"

#include <visp3/core/vpException.h>
#include <visp3/pattern/vpCalibrationPoint.h>

#include <Eigen/Dense>

#include <cmath>
#include <initializer_list>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double unknownSigma = 0.1; // px, see vpCalibrationPoints()

constexpr double alike = 0.98; // of the best similarity: bases that look the same

double known(double sigma) { return std::isfinite(sigma) ? sigma : unknownSigma; }

// Columns: the steps to the next column and row on the object, m.
Eigen::Matrix2d basisOf(const vpCalibrationPitch &pitch, const vpDotLattice &seen)
{
  double angle = pitch.angle;
  if (std::isnan(angle)) {
    const bool hexagonal = pitch.columns == pitch.rows && std::string(seen.name()) == "hexagonal";
    angle = hexagonal ? M_PI / 3. : M_PI / 2.;
  }
  Eigen::Matrix2d basis;
  basis << pitch.columns, pitch.rows * std::cos(angle), 0., pitch.rows * std::sin(angle);
  return basis;
}

// Similarity of a map to a scaled rotation: its smaller over its larger singular value, less when it mirrors.
double likeness(const Eigen::Matrix2d &map)
{
  const Eigen::Vector2d s = Eigen::JacobiSVD<Eigen::Matrix2d>(map).singularValues();
  return (map.determinant() < 0. ? alike * alike : 1.) * s[1] / s[0];
}

// From (column, row) of the lattice found to (column, row) of the object.
Eigen::Matrix2d renumbering(const Eigen::Matrix2d &seen, const Eigen::Matrix2d &object)
{
  Eigen::Matrix2d best = Eigen::Matrix2d::Identity();
  double bestLikeness = 0., bestRight = -2.;
  const Eigen::Matrix2d inverse = object.inverse();
  for (int code = 0; code < 625; ++code) { // all bases of steps up to two
    Eigen::Matrix2d steps;
    steps << code % 5 - 2, code / 5 % 5 - 2, code / 25 % 5 - 2, code / 125 - 2;
    if (std::abs(std::abs(steps.determinant()) - 1.) > 0.5) {
      continue;
    }
    const Eigen::Matrix2d basis = seen * steps;
    const double like = likeness(basis * inverse), right = basis(0, 0) / basis.col(0).norm();
    if (like > bestLikeness / alike || (like > bestLikeness * alike && right > bestRight)) {
      bestLikeness = std::max(bestLikeness, like);
      bestRight = right;
      best = steps.inverse();
    }
  }
  return best;
}

vpCalibrationSpread spreadOf(const Eigen::Matrix<double, 3, Eigen::Dynamic> &all)
{
  vpCalibrationSpread spread;
  spread.centre = all.rowwise().mean();
  const Eigen::Matrix<double, 3, Eigen::Dynamic> centred = all.colwise() - spread.centre;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(centred, Eigen::ComputeFullU);
  spread.axes = svd.matrixU();
  if (spread.axes.determinant() < 0.) {
    spread.axes.col(2) *= -1.;
  }
  spread.sigma.setZero();
  spread.sigma.head(svd.singularValues().size()) = svd.singularValues() / std::sqrt(static_cast<double>(all.cols()));
  return spread;
}
} // namespace

void vpCalibrationPitch::check() const
{
  constexpr vpFieldCheck fields("the pitch");
  fields.positive("columns", columns, "m");
  fields.positive("rows", rows, "m");
  fields.notNegative("sigmaPlane", sigmaPlane, "m");
  if (!std::isnan(angle)) { // NaN: unknown
    fields.in("angle", angle, {0.5, 2.7}, "rad");
  }
}

std::vector<vpCalibrationPoint> vpCalibrationPoints(const vpPatternFrame &frame, const vpCalibrationPitch &pitch)
{
  pitch.check();
  vpDotLattice seen;
  seen.kind = vpDotLatticeKind::Plane;
  seen.ax = frame.lattice.columnPitchX;
  seen.ay = frame.lattice.columnPitchY;
  seen.bx = frame.lattice.rowPitchX;
  seen.by = frame.lattice.rowPitchY;
  const Eigen::Matrix2d object = basisOf(pitch, seen);
  std::vector<vpCalibrationPoint> points;
  for (const vpPatternCell &cell : frame.cells) {
    if (cell.valid) {
      vpCalibrationPoint point;
      point.u = cell.x;
      point.v = cell.y;
      point.x = cell.column * object(0, 0) + cell.row * object(0, 1);
      point.y = cell.row * object(1, 1);
      point.sigmaU = known(cell.sigmaX);
      point.sigmaV = known(cell.sigmaY);
      point.sigmaPlane = pitch.sigmaPlane;
      points.push_back(point);
    }
  }
  return points;
}

std::vector<vpCalibrationPoint> vpCalibrationPoints(const vpDotLattice &lattice, const vpCalibrationPitch &pitch)
{
  pitch.check();
  if (lattice.kind != vpDotLatticeKind::Plane) {
    throw vpException(vpException::fatalError, "no dots of a grid were found: %s", lattice.message.c_str());
  }
  Eigen::Matrix2d seen;
  seen << lattice.ax, lattice.bx, lattice.ay, lattice.by;
  const Eigen::Matrix2d object = basisOf(pitch, lattice), numbers = renumbering(seen, object);
  std::vector<vpCalibrationPoint> points;
  for (const vpLatticeDot &dot : lattice.dots) {
    const Eigen::Vector2d place = object * (numbers * Eigen::Vector2d(dot.column, dot.row));
    vpCalibrationPoint point;
    point.u = dot.x;
    point.v = dot.y;
    point.x = place.x();
    point.y = place.y();
    point.sigmaU = point.sigmaV = unknownSigma;
    point.sigmaPlane = pitch.sigmaPlane;
    points.push_back(point);
  }
  return points;
}

std::vector<vpCalibrationPoint> vpCalibrationPoints(const vpImage<unsigned char> &image,
                                                    const vpCalibrationPitch &pitch)
{
  pitch.check();
  return vpCalibrationPoints(vpFindDotLattice(image), pitch);
}

void vpCheckCalibrationImage(unsigned int width, unsigned int height)
{
  vpCheckField("width", "the calibration", width, "px", {8., 65536.});
  vpCheckField("height", "the calibration", height, "px", {8., 65536.});
}

void vpCheckPrincipalPoint(const char *field, double value)
{
  if (std::isinf(value) || std::abs(value) > 1e6) {
    throw vpException(vpException::badValue, "%s is %g px, must be within 1e6 px or NaN for the centre of the image",
                      field, value);
  }
}

void vpCheckCalibrationView(std::size_t view, const std::vector<vpCalibrationPoint> &points, std::size_t least)
{
  if (points.size() < least) {
    throw vpException(vpException::badValue, "view %zu has %zu points, must have at least %zu", view, points.size(),
                      least);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const vpCalibrationPoint &p = points[i];
    const std::initializer_list<std::pair<const char *, double>> places = {
        {"u", p.u}, {"v", p.v}, {"x", p.x}, {"y", p.y}, {"z", p.z}};
    for (const auto &[name, value] : places) {
      if (!std::isfinite(value)) {
        throw vpException(vpException::badValue, "point %zu of view %zu: %s is %g, must be finite", i, view, name,
                          value);
      }
    }
    const std::initializer_list<std::pair<const char *, double>> deviations = {{"sigmaU", p.sigmaU},
                                                                               {"sigmaV", p.sigmaV}};
    for (const auto &[name, value] : deviations) {
      if (!(value > 0. && std::isfinite(value))) {
        throw vpException(vpException::badValue, "point %zu of view %zu: %s is %g px, must be > 0", i, view, name,
                          value);
      }
    }
    if (!(p.sigmaPlane >= 0. && std::isfinite(p.sigmaPlane))) {
      throw vpException(vpException::badValue, "point %zu of view %zu: sigmaPlane is %g m, must be >= 0", i, view,
                        p.sigmaPlane);
    }
  }
}

bool vpNullVector(const Eigen::MatrixXd &rows, double leastGap, Eigen::VectorXd &h)
{
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullV);
  const Eigen::VectorXd &s = svd.singularValues();
  const Eigen::Index last = rows.cols() - 1;
  if (rows.rows() < last || !(s[last - 1] > leastGap * s[0])) {
    return false;
  }
  h = svd.matrixV().col(last);
  return true;
}

vpCalibrationSpread vpSpreadOf(const std::vector<vpCalibrationPoint> &points)
{
  Eigen::Matrix<double, 3, Eigen::Dynamic> all(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    all.col(static_cast<Eigen::Index>(i)) << points[i].x, points[i].y, points[i].z;
  }
  return spreadOf(all);
}

vpCalibrationSpread vpImageSpreadOf(const std::vector<vpCalibrationPoint> &points)
{
  Eigen::Matrix<double, 3, Eigen::Dynamic> all(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    all.col(static_cast<Eigen::Index>(i)) << points[i].u, points[i].v, 0.;
  }
  return spreadOf(all);
}

END_VISP_NAMESPACE
