/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpSelfMotionIndex.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
constexpr double pi = 3.14159265358979323846;
constexpr double tiny = 1e-9;

bool pointwise(vpIndexKind kind)
{
  return kind == vpIndexKind::PointDistance || kind == vpIndexKind::LineDistance || kind == vpIndexKind::PlaneDistance;
}

bool isUsual(double value) { return value >= 1e-9 && value <= vpArmLargest; }

// Empty if the index is valid; for the loop and for validate().
const char *complaint(const vpArmModel &model, const vpSelfMotionIndex &index)
{
  if (!(index.gain >= 0.) || index.gain > vpArmLargest) {
    return "gain must be >= 0 and finite, at most 1e9";
  }
  if (pointwise(index.kind)) {
    if (index.joint < 0 || index.joint >= model.links()) {
      return "joint must be one of the chain, from 0 on";
    }
    if (!isUsual(index.range)) {
      return "range must be > 0 and finite, from 1e-9 to 1e9";
    }
    if (!vpIsPlausibleForArm(index.point)) {
      return "point must be finite, at most 1e9";
    }
    if (index.kind == vpIndexKind::PlaneDistance && !(std::fabs(index.normal.norm() - 1.) < 1e-6)) {
      return "normal must have length 1";
    }
  }
  if (index.kind == vpIndexKind::Posture &&
      (index.reference.size() != model.size() || !vpIsPlausibleForArm(index.reference))) {
    return "reference must have a finite number for each joint, at most 1e9";
  }
  if (index.kind == vpIndexKind::Manipulability) {
    if (!isUsual(index.taskLength)) {
      return "taskLength must be > 0 and finite, from 1e-9 to 1e9";
    }
    if (index.weights.size() != 0 &&
        (index.weights.size() != model.size() || !std::all_of(index.weights.begin(), index.weights.end(), isUsual))) {
      return "weights must have a number > 0 for each joint, from 1e-9 to 1e9";
    }
  }
  return "";
}

// Matrix A = J J^T (or J^T J when there are fewer than six joints), factored; B = A^-1 J (or J A^-1).
template <class Square> bool factor(const Square &A, Eigen::LLT<Square> &llt, double &root)
{
  llt.compute(A);
  root = llt.matrixLLT().diagonal().prod(); // sqrt(det A)
  return llt.info() == Eigen::Success && root > 0. && std::isfinite(root);
}

bool manipulability(const vpArmModel &model, const vpArmData &data, const vpSelfMotionIndex &index,
                    vpIndexValue &result)
{
  const int n = model.size();
  vpJointVector scale = vpJointVector::Ones(n); // W^-1/2
  for (int i = 0; i < n && index.weights.size() != 0; ++i) {
    scale(i) = 1. / std::sqrt(index.weights(i));
  }
  Vector6 rows = Vector6::Ones();
  rows.tail<3>().setConstant(index.taskLength);
  vpArmJacobian J(6, n), G(6, n); // G is the transposed pseudo-inverse of the scaled Jacobian
  for (int i = 0; i < n; ++i) {
    J.col(i) = scale(i) * rows.cwiseProduct(data.J.col(i));
  }
  if (n >= 6) {
    Matrix6 A = Matrix6::Zero();
    for (int i = 0; i < n; ++i) {
      const Vector6 column = J.col(i);
      A += column * column.transpose();
    }
    Eigen::LLT<Matrix6> llt;
    if (!factor(A, llt, result.value)) {
      result.value = 0.;
      return false;
    }
    for (int i = 0; i < n; ++i) {
      const Vector6 column = J.col(i);
      G.col(i) = llt.solve(column);
    }
  }
  else {
    vpJointMatrix A(n, n);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        A(i, j) = J.col(i).dot(J.col(j));
      }
    }
    Eigen::LLT<vpJointMatrix> llt(n);
    if (!factor(A, llt, result.value)) {
      result.value = 0.;
      return false;
    }
    for (int row = 0; row < 6; ++row) {
      vpJointVector right = J.row(row).transpose();
      llt.solveInPlace(right);
      G.row(row) = right.transpose();
    }
  }
  for (int i = 0; i < n; ++i) {
    G.col(i) = scale(i) * rows.cwiseProduct(G.col(i));
  }
  // tr(dJ/dq_k G^T) with the two cases of vpArmKinematics::derivative() summed over the columns first: a revolute
  // k turns all columns from k on, and column k lengthens the arms of the revolute ones before it. Here k counts all of
  // the chain: a follower has its share of the column of its joint.
  const int links = model.toolLink();
  vpArmJacobian C(6, links);
  for (int k = 0; k < links; ++k) {
    const Eigen::Vector3d z = data.joint[static_cast<std::size_t>(k)].R.col(2);
    const Eigen::Vector3d lever = data.tool.p - data.joint[static_cast<std::size_t>(k)].p;
    const bool slides = model.chain(k).isPrismatic;
    C.col(k) << (slides ? z : Eigen::Vector3d(z.cross(lever))), (slides ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : z);
  }
  Eigen::Vector3d turned = Eigen::Vector3d::Zero(), lengthened = Eigen::Vector3d::Zero();
  for (int k = links - 1; k >= 0; --k) {
    const vpArmChainJoint &own = model.chain(k);
    const Eigen::Vector3d v = C.col(k).head<3>(), w = C.col(k).tail<3>(); // w is zero for a prismatic joint
    turned += own.ratio * (v.cross(G.col(own.joint).head<3>()) + w.cross(G.col(own.joint).tail<3>()));
    result.gradient(own.joint) += own.ratio * turned.dot(w);
  }
  for (int k = 0; k < links; ++k) {
    const vpArmChainJoint &own = model.chain(k);
    const Eigen::Vector3d v = C.col(k).head<3>(), w = C.col(k).tail<3>();
    result.gradient(own.joint) += own.ratio * lengthened.dot(v);
    lengthened += own.ratio * Eigen::Vector3d(G.col(own.joint).head<3>()).cross(w);
  }
  result.gradient *= result.value;
  return true;
}

// Value and derivative of an index as a function of the distance.
void wish(const vpSelfMotionIndex &index, double d, double &value, double &slope)
{
  const double s = index.range, x = d / s;
  if (index.sense == vpIndexSense::Attract) {
    const double root = std::sqrt(1. + x * x);
    value = -s * (root - 1.);
    slope = -x / root;
  }
  else if (index.kind == vpIndexKind::PlaneDistance) {
    // The logarithm in a form that does not overflow far on the wrong side.
    value = x > 0. ? -s * std::log1p(std::exp(-x)) : s * x - s * std::log1p(std::exp(x));
    slope = x > 0. ? std::exp(-x) / (1. + std::exp(-x)) : 1. / (1. + std::exp(x));
  }
  else {
    slope = std::exp(-x);
    value = -s * slope;
  }
}

bool distance(const vpArmModel &model, const vpArmData &data, const vpSelfMotionIndex &index, vpIndexValue &result)
{
  const Eigen::Vector3d at = data.joint[static_cast<std::size_t>(index.joint)].p;
  const auto J = vpArmKinematics::pointJacobian(model, data, index.joint);
  Eigen::Vector3d direction; // of increasing distance
  double share = 0.;         // with which the foot point on the line follows the tool
  if (index.kind == vpIndexKind::PlaneDistance) {
    result.distance = index.normal.dot(at - index.point);
    direction = index.normal;
  }
  else {
    Eigen::Vector3d foot = index.point;
    if (index.kind == vpIndexKind::LineDistance) {
      const double length = data.tool.p.squaredNorm(); // the base is the origin
      share = length > tiny * tiny ? std::min(1., std::max(0., at.dot(data.tool.p) / length)) : 0.;
      foot = share * data.tool.p;
    }
    result.distance = (at - foot).norm();
    direction = result.distance > tiny ? Eigen::Vector3d((at - foot) / result.distance) : Eigen::Vector3d::Zero();
  }
  double slope = 0.;
  wish(index, result.distance, result.value, slope);
  for (int i = 0; i < model.size(); ++i) {
    // The foot point's motion along the line does not change the distance; that of the line with the tool does.
    result.gradient(i) = slope * direction.dot(J.col(i) - share * data.J.col(i).head<3>());
  }
  return direction.squaredNorm() > 0.;
}

bool jointLimits(const vpArmModel &model, const vpArmData &data, vpIndexValue &result)
{
  int count = 0;
  for (int i = 0; i < model.size(); ++i) {
    if (!model.isContinuous(i)) {
      const double half = 0.5 * (model.upper()(i) - model.lower()(i));
      const double x = (data.q(i) - model.lower()(i)) / half - 1.;
      result.value -= 0.5 * x * x;
      result.gradient(i) = -x / half;
      ++count;
    }
  }
  if (count > 0) {
    result.value /= count;
    result.gradient /= count;
  }
  return count > 0;
}

bool posture(const vpArmModel &model, const vpArmData &data, const vpSelfMotionIndex &index, vpIndexValue &result)
{
  for (int i = 0; i < model.size(); ++i) {
    const double d = index.reference(i) - data.q(i);
    result.gradient(i) = model.isContinuous(i) ? std::remainder(d, 2. * pi) : d;
  }
  result.value = -0.5 * result.gradient.squaredNorm();
  return true;
}
} // namespace

vpSelfMotionIndex vpSelfMotionIndex::manipulability(double gain)
{
  vpSelfMotionIndex index;
  index.gain = gain;
  return index;
}

vpSelfMotionIndex vpSelfMotionIndex::weightedManipulability(const vpJointVector &weights, double taskLength,
                                                            double gain)
{
  vpSelfMotionIndex index;
  index.gain = gain;
  index.weights = weights;
  index.taskLength = taskLength;
  return index;
}

vpSelfMotionIndex vpSelfMotionIndex::pointDistance(int joint, const Eigen::Vector3d &point, vpIndexSense sense,
                                                   double gain, double range)
{
  vpSelfMotionIndex index;
  index.kind = vpIndexKind::PointDistance;
  index.joint = joint;
  index.point = point;
  index.sense = sense;
  index.gain = gain;
  index.range = range;
  return index;
}

vpSelfMotionIndex vpSelfMotionIndex::lineDistance(int joint, vpIndexSense sense, double gain, double range)
{
  vpSelfMotionIndex index = pointDistance(joint, Eigen::Vector3d::Zero(), sense, gain, range);
  index.kind = vpIndexKind::LineDistance;
  return index;
}

vpSelfMotionIndex vpSelfMotionIndex::planeDistance(int joint, const Eigen::Vector3d &point,
                                                   const Eigen::Vector3d &normal, vpIndexSense sense, double gain,
                                                   double range)
{
  vpSelfMotionIndex index = pointDistance(joint, point, sense, gain, range);
  index.kind = vpIndexKind::PlaneDistance;
  index.normal = normal.normalized();
  return index;
}

vpSelfMotionIndex vpSelfMotionIndex::jointLimits(double gain)
{
  vpSelfMotionIndex index;
  index.kind = vpIndexKind::JointLimits;
  index.gain = gain;
  return index;
}

vpSelfMotionIndex vpSelfMotionIndex::posture(const vpJointVector &reference, double gain)
{
  vpSelfMotionIndex index;
  index.kind = vpIndexKind::Posture;
  index.reference = reference;
  index.gain = gain;
  return index;
}

void vpSelfMotionIndex::validate(const vpArmModel &model) const
{
  const char *text = complaint(model, *this);
  if (*text != '\0') {
    throw vpException(vpException::badValue,
                      "self-motion index of %s: %s (gain %g, joint %d of %d, range %g, |normal| %g, taskLength %g)",
                      model.label().c_str(), text, gain, joint, model.size(), range, normal.norm(), taskLength);
  }
}

namespace
{
bool evaluate(const vpArmModel &model, const vpArmData &data, const vpSelfMotionIndex &index, vpIndexValue &result)
{
  switch (index.kind) {
  case vpIndexKind::Manipulability:
    return manipulability(model, data, index, result);
  case vpIndexKind::JointLimits:
    return jointLimits(model, data, result);
  case vpIndexKind::Posture:
    return posture(model, data, index, result);
  default:
    return distance(model, data, index, result);
  }
}

void clear(const vpArmModel &model, vpIndexValue &result)
{
  result.value = result.distance = 0.;
  result.gradient.setZero(model.size());
}
} // namespace

bool vpEvaluateIndex(const vpArmModel &model, const vpArmData &data, const vpSelfMotionIndex &index,
                     vpIndexValue &result) noexcept
{
  clear(model, result);
  if (data.size != model.size() || data.J.cols() != data.size || *complaint(model, index) != '\0') {
    return false;
  }
  const bool climbs = evaluate(model, data, index, result);
  if (!std::isfinite(result.value) || !std::isfinite(result.distance) || !result.gradient.allFinite()) {
    clear(model, result);
    return false;
  }
  return climbs;
}

END_VISP_NAMESPACE
