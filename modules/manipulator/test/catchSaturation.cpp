/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Velocity limits of single joints: the others take over, compared with the best share by enumeration.
#include "vpArmTestKit.h"
#include "vpCaseFile.h"
#include "vpCatch.h"

#include <visp3/direct_core/vpSO3.h>
#include <visp3/manipulator/vpArmUrdf.h>
#include <visp3/manipulator/vpRedundancySolver.h>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <iostream>

using namespace vpArmTestKit;

namespace
{
using Vector6 = Eigen::Matrix<double, 6, 1>;

// AMOR on a column that lifts it slowly, joints with random velocity limits; n = 8. Without the column n = 7.
vpArmModel slowJoints(std::mt19937_64 &rng, bool column)
{
  vpArmSpec spec = amor().spec();
  if (column) {
    vpArmJointSpec lift;
    lift.name = "column";
    lift.type = vpJointType::Prismatic;
    lift.upper = 0.5;
    lift.velocity = std::exp(uniform(rng, -5., 0.));
    lift.acceleration = 5.;
    spec.joints.insert(spec.joints.begin(), lift);
    spec.links.clear();
    spec.capsules.clear();
    spec.home.resize(0);
  }
  for (std::size_t i = column ? 1 : 0; i < spec.joints.size(); ++i) {
    spec.joints[i].velocity = std::exp(uniform(rng, -3., 1.5));
  }
  return vpArmModel(spec);
}

// The same without position limits, and with any acceleration.
vpArmModel withoutOtherLimits(const vpArmModel &model)
{
  vpArmSpec spec = model.spec();
  for (vpArmJointSpec &joint : spec.joints) {
    joint.lower -= 100.;
    joint.upper += 100.;
    joint.acceleration = 1e6;
  }
  return vpArmModel(spec);
}

// Largest s <= 1 with J q' = s x and |q'| <= limit: a vertex of the polytope of s and the self-motion, by enumeration.
double bestShare(const Eigen::MatrixXd &J, const Vector6 &x, const Eigen::VectorXd &limit)
{
  const Eigen::Index n = J.cols(), d = n - 6, rows = 2 * n + 1;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(rows, d + 1);
  Eigen::VectorXd most(rows);
  C.col(0).head(n) = svd.solve(x);
  C.topRightCorner(n, d) = svd.matrixV().rightCols(d);
  C.middleRows(n, n) = -C.topRows(n);
  C(2 * n, 0) = 1.;
  most << limit, limit, 1.;
  double best = 0.;
  std::vector<bool> chosen(static_cast<std::size_t>(rows), false);
  std::fill_n(chosen.begin(), d + 1, true);
  do {
    Eigen::MatrixXd A(d + 1, d + 1);
    Eigen::VectorXd b(d + 1);
    for (Eigen::Index i = 0, k = 0; i < rows; ++i) {
      if (chosen[static_cast<std::size_t>(i)]) {
        A.row(k) = C.row(i);
        b(k++) = most(i);
      }
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(A);
    const Eigen::VectorXd y = lu.solve(b);
    if (lu.isInvertible() && y(0) > best && (C * y - most).maxCoeff() < 1e-9) {
      best = y(0);
    }
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return best;
}

struct Twist {
  Vector6 scaled; // rad/s times the task length
  vpRedundancyInput input;
};

Twist randomTwist(const vpArmModel &model, double size, std::mt19937_64 &rng)
{
  Twist twist;
  for (int k = 0; k < 6; ++k) {
    twist.scaled(k) = uniform(rng, -1., 1.);
  }
  twist.scaled *= size / twist.scaled.norm();
  const double length = vpRedundancySpec().taskLength;
  for (std::size_t k = 0; k < 6; ++k) {
    twist.input.twist[k] = twist.scaled(static_cast<Eigen::Index>(k)) / (k < 3 ? 1. : length);
  }
  twist.input.previous = vpJointVector::Zero(model.size());
  return twist;
}

Eigen::MatrixXd scaledJacobian(const vpArmModel &model, const vpArmData &data)
{
  Eigen::MatrixXd J = vpArmKinematics::geometric(model, data, vpArmFrame::Camera);
  J.bottomRows<3>() *= vpRedundancySpec().taskLength;
  return J;
}

// The torso of the PR2, 0.013 m/s, and its right arm.
vpArmModel pr2(const std::string &file)
{
  vpArmUrdfSpec spec;
  spec.base = "base_link";
  spec.tip = "r_wrist_roll_link";
  spec.acceleration = 10.;
  return vpLoadArmUrdf(file, spec);
}

vpJointVector insideLimits(const vpArmModel &model, double range, std::mt19937_64 &rng)
{
  vpJointVector q(model.size());
  for (int i = 0; i < model.size(); ++i) {
    const double lower = model.isContinuous(i) ? -2. : model.lower()(i);
    const double upper = model.isContinuous(i) ? 2. : model.upper()(i);
    q(i) = 0.5 * (lower + upper) + 0.5 * range * (upper - lower) * uniform(rng, -1., 1.);
  }
  return q;
}

// Mean share of random twists in regular configurations, of scaling, of the solver, and of the oracle.
struct Shares {
  double scaling = 0., solver = 0., most = 0.;
  int count = 0, maximal = 0;

  void add(const vpArmModel &limited, const vpJointVector &q, double size, std::mt19937_64 &rng)
  {
    const vpArmModel model = withoutOtherLimits(limited);
    const int n = model.size();
    vpArmData data;
    vpArmKinematics::update(model, q, data);
    const Eigen::MatrixXd J = scaledJacobian(model, data);
    if (J.jacobiSvd().singularValues()(5) < 0.051) {
      return;
    }
    const Twist twist = randomTwist(model, size, rng);
    vpRedundancyOutput out;
    vpRedundancySolver(model).step(data, twist.input, out);
    const double best = bestShare(J, twist.scaled, model.velocity());
    const Eigen::VectorXd plain = J.transpose() * (J * J.transpose()).inverse() * twist.scaled;
    const double scaled = std::min(1., model.velocity().cwiseQuotient(plain.cwiseAbs()).minCoeff());
    CAPTURE(q.transpose(), twist.scaled.transpose(), model.velocity().transpose(), out.velocity.transpose(), best);
    REQUIRE((J * out.velocity - out.scale * twist.scaled).norm() < 1e-9); // on the path
    REQUIRE((out.velocity.cwiseAbs() - model.velocity()).maxCoeff() <= 0.);
    REQUIRE(out.scale <= best + 1e-9);
    REQUIRE(out.scale >= scaled - 1e-9);
    const vpRedundancyStatus status = out.scale < 0.01        ? vpRedundancyStatus::BlockedByLimits
                                      : out.scale < 1. - 1e-9 ? vpRedundancyStatus::Scaled
                                                              : vpRedundancyStatus::Exact;
    REQUIRE(out.status == status);
    for (int i = 0; i < n; ++i) {
      const bool held = (out.saturatedJoints >> i & 1U) != 0U;
      REQUIRE((!held || std::fabs(out.velocity(i)) > model.velocity()(i) * (1. - 1e-9)));
    }
    if (scaled >= 1.) { // nothing changes without saturation
      REQUIRE(out.saturatedJoints == 0U);
      REQUIRE((out.velocity - plain).norm() < 1e-9 * (1. + plain.norm()));
    }
    vpRedundancySpec byLimits;
    byLimits.weights = model.velocity().cwiseAbs2().cwiseInverse();
    vpRedundancyOutput other;
    vpRedundancySolver(model, byLimits).step(data, twist.input, other);
    REQUIRE((other.velocity.cwiseAbs() - model.velocity()).maxCoeff() <= 0.);
    scaling += scaled;
    solver += out.scale;
    most += best;
    maximal += out.scale > best * (1. - 1e-6) ? 1 : 0;
    ++count;
  }
  void print(const char *name) const
  {
    std::cout << name << ": mean share of " << count << " twists " << scaling / count << " by scaling, "
              << solver / count << " by saturation, " << most / count << " at most; maximal in "
              << 100. * maximal / count << " %\n";
  }
};
} // namespace

TEST_CASE("The others take over the share of joints at their velocity limits", "[saturation]")
{
  auto rng = vpTestSupport::generator(91);
  CAPTURE(vpTestSupport::seed());
  for (const bool column : {false, true}) {
    Shares shares;
    for (int problem = 0; problem < 1500; ++problem) {
      const vpArmModel model = slowJoints(rng, column);
      shares.add(model, insideLimits(model, 0.9, rng), std::exp(uniform(rng, -3., 0.5)), rng);
    }
    shares.print(column ? "AMOR on a column" : "AMOR with random velocity limits");
    CHECK(shares.count > 700);
    CHECK(shares.solver > 0.97 * shares.most);
    CHECK(shares.maximal > 0.75 * shares.count);
  }
}

TEST_CASE("PR2: share of random twists", "[saturation][cases]")
{
  const std::string file = vpTestSupport::caseFile("robots/pr2.urdf");
  if (file.empty()) {
    return;
  }
  auto rng = vpTestSupport::generator(92);
  CAPTURE(vpTestSupport::seed());
  const vpArmModel model = pr2(file);
  Shares shares;
  for (int problem = 0; problem < 1500; ++problem) {
    shares.add(model, insideLimits(model, 0.9, rng), problem % 2 == 0 ? 0.4 : 1.2, rng);
  }
  shares.print("PR2");
  CHECK(shares.scaling < 0.3 * shares.count);
  CHECK(shares.solver > 0.99 * shares.most);
}

TEST_CASE("PR2: torso and arm reach every pose", "[saturation][cases]")
{
  const std::string file = vpTestSupport::caseFile("robots/pr2.urdf");
  if (file.empty()) {
    return;
  }
  auto rng = vpTestSupport::generator(93);
  CAPTURE(vpTestSupport::seed());
  const vpArmModel model = pr2(file);
  const vpRedundancySolver solver(model);
  int reached = 0;
  for (int pose = 0; pose < 100; ++pose) {
    vpJointVector q = insideLimits(model, 0.5, rng), goal = q;
    for (int i = 0; i < 8; ++i) { // near, and not at a limit
      const double lower = model.isContinuous(i) ? -2. : model.lower()(i);
      const double upper = model.isContinuous(i) ? 2. : model.upper()(i), edge = 0.15 * (upper - lower);
      const double to = q(i) + (i == 0 ? 0.1 : 0.5) * uniform(rng, -1., 1.);
      goal(i) = std::min(upper - edge, std::max(lower + edge, to));
    }
    vpArmData data, end;
    vpArmKinematics::forward(model, goal, end);
    vpRedundancyInput in;
    vpRedundancyOutput out;
    in.frame = vpArmFrame::EndEffector;
    in.previous = vpJointVector::Zero(8);
    Vector6 error;
    for (int k = 0; k < 2000; ++k) {
      vpArmKinematics::update(model, q, data);
      error << data.tool.R.transpose() * (end.tool.p - data.tool.p), vpSO3::log(data.tool.R.transpose() * end.tool.R);
      const double hurry = std::max({1., error.head<3>().norm() / 0.25, error.tail<3>().norm() / 0.8});
      for (std::size_t c = 0; c < 6; ++c) {
        in.twist[c] = error(static_cast<Eigen::Index>(c)) / hurry;
      }
      solver.step(data, in, out);
      REQUIRE((out.velocity.cwiseAbs() - model.velocity()).maxCoeff() <= 0.);
      in.previous = out.velocity;
      q += 0.005 * out.velocity;
      REQUIRE(model.outsideLimits(q).empty());
    }
    reached += error.head<3>().norm() < 1e-3 && error.tail<3>().norm() < 0.1 * pi / 180. ? 1 : 0;
  }
  std::cout << "PR2: " << reached << " of 100 poses reached\n";
  CHECK(reached == 100);
}

TEST_CASE("With saturated joints all limits hold, and self-motion moves neither them nor the task", "[saturation]")
{
  auto rng = vpTestSupport::generator(94);
  CAPTURE(vpTestSupport::seed());
  int saturated = 0, moving = 0;
  for (int problem = 0; problem < 4000; ++problem) {
    const vpArmModel model = slowJoints(rng, problem % 2 == 0);
    const int n = model.size();
    vpRedundancySpec spec;
    if (problem % 3 == 0) {
      spec.weights = model.velocity().cwiseAbs2().cwiseInverse();
    }
    const vpRedundancySolver solver(model, spec);
    vpArmData data;
    vpArmKinematics::update(model, insideLimits(model, 1., rng), data);
    vpRedundancyInput in = randomTwist(model, std::exp(uniform(rng, -3., 1.)), rng).input;
    in.previous = 0.2 * model.velocity().cwiseProduct(randomVector(n, rng));
    in.indices[0] = vpSelfMotionIndex::jointLimits();
    in.indexCount = 1;
    in.free[5] = problem % 2 == 1;
    if (problem % 5 == 0) {
      in.tasks[0] = vpArmTask::pointVelocity(model, data, 3, Eigen::Vector3d(0.1, -0.2, 0.1));
      in.taskCount = 1;
    }
    vpRedundancyOutput out;
    for (int k = 0; k < 20; ++k) {
      const vpJointVector before = in.previous;
      solver.step(data, in, out);
      CAPTURE(problem, out.message(), out.velocity.transpose(), before.transpose());
      REQUIRE((out.velocity.cwiseAbs() - model.velocity()).maxCoeff() <= 0.);
      REQUIRE(((out.velocity - before).cwiseAbs() - 0.005 * (1. + 1e-9) * model.acceleration()).maxCoeff() <= 0.);
      in.previous = out.velocity;
    }
    saturated += out.saturatedJoints != 0U ? 1 : 0;
    moving += out.saturatedJoints != 0U && out.selfMotion.norm() > 1e-3 ? 1 : 0;
    Vector6 moved = scaledJacobian(model, data) * out.selfMotion;
    moved(5) = in.free[5] ? 0. : moved(5);
    REQUIRE((out.smallestSingular < 1e-4 || moved.norm() < 1e-9 * (1. + out.selfMotion.norm())));
    for (int i = 0; i < n; ++i) {
      REQUIRE(((out.saturatedJoints >> i & 1U) == 0U || out.selfMotion(i) == 0.));
    }
  }
  std::cout << saturated << " of 4000 end with saturated joints, " << moving << " of them with self-motion\n";
  CHECK(saturated > 400);
  CHECK(moving > 100);
}
