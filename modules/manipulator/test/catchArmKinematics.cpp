/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Forward kinematics and Jacobians against KDL, reference poses and finite differences.
#include "vpKdlTestKit.h"
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include <Eigen/LU>

#include <iostream>

using namespace vpArmTestKit;

namespace
{
constexpr vpArmFrame frames[] = {vpArmFrame::Base, vpArmFrame::EndEffector, vpArmFrame::Camera};

void compareWithKDL(const vpArmModel &model, const KDL::Chain &chain, unsigned int stream)
{
  auto rng = vpTestSupport::generator(stream);
  CAPTURE(vpTestSupport::seed(), model.label());
  KDL::ChainFkSolverPos_recursive fk(chain);
  KDL::ChainJntToJacSolver jac(chain);
  KDL::JntArray q(chain.getNrOfJoints());
  KDL::Jacobian J(chain.getNrOfJoints());
  vpArmData data;
  double worstPose = 0., worstJacobian = 0.;
  for (int problem = 0; problem < 100000; ++problem) {
    const vpJointVector configuration = vpArmTestKit::configuration(model, rng);
    q.data = configuration;
    vpArmKinematics::update(model, configuration, data);
    KDL::Frame pose;
    fk.JntToCart(q, pose);
    jac.JntToJac(q, J);
    for (int i = 0; i < 3; ++i) {
      worstPose = std::max(worstPose, std::fabs(data.tool.p(i) - pose.p(i)));
      for (int j = 0; j < 3; ++j) {
        worstPose = std::max(worstPose, std::fabs(data.tool.R(i, j) - pose.M(i, j)));
      }
    }
    worstJacobian = std::max(worstJacobian, (data.J - J.data).cwiseAbs().maxCoeff());
  }
  std::cout << model.spec().name << ": 100000 configurations, largest difference from KDL: pose " << worstPose
            << ", Jacobian " << worstJacobian << '\n';
  CHECK(worstPose < 1e-12);
  CHECK(worstJacobian < 1e-12);
}

int problemsOf(const vpArmModel &model) { return model.spec().followers.empty() ? 1000 : 20; }

vpArmData at(const vpArmModel &model, vpJointVector q, int joint, double step)
{
  q(joint) += step;
  vpArmData data;
  vpArmKinematics::update(model, q, data);
  return data;
}

vpRigidTransform poseOf(const vpArmModel &model, const vpArmData &data, vpArmFrame frame)
{
  return frame == vpArmFrame::Camera ? vpArmKinematics::camera(model, data) : data.tool;
}
} // namespace

TEST_CASE("AMOR is KDL's", "[kinematics]") { compareWithKDL(amor(), kdlAmor(), 1); }
TEST_CASE("The six axes are KDL's", "[kinematics]") { compareWithKDL(sixAxes(), kdlSixAxes(), 2); }

TEST_CASE("AMOR stands at its reference poses", "[kinematics]")
{
  // The raw table: no offset of joint 2, no tool.
  vpArmSpec raw = amor().spec();
  raw.joints[1].offset = 0.;
  raw.tool = {};
  const vpArmModel table(raw);
  vpArmData data;
  vpArmKinematics::update(table, vector({.1, .2, .3, -.4, .5, .6, .7}), data);
  Eigen::Matrix<double, 3, 4> expected;
  expected << 0.151512, -0.951998, -0.265976, 0.160279, //
      -0.935190, -0.225200, 0.273322, -0.068315,        //
      -0.320100, 0.207327, -0.924420, -0.678515;
  Eigen::Matrix<double, 3, 4> pose;
  pose << data.tool.R, data.tool.p;
  CAPTURE(pose);
  CHECK((pose - expected).cwiseAbs().maxCoeff() < 1e-6);

  vpArmKinematics::update(amor(), home(), data);
  CAPTURE(data.tool.p.transpose(), data.joint[3].p.transpose());
  CHECK((data.tool.p - Eigen::Vector3d(0.0499, 0.6301, 0.3503)).cwiseAbs().maxCoeff() <
        6e-5); // four decimals are given
  CHECK((data.joint[3].p - Eigen::Vector3d(0.328611, 0.177000, 0.450369)).cwiseAbs().maxCoeff() < 1e-6);
  CHECK(std::sqrt((data.J * data.J.transpose()).determinant()) == Approx(0.0570).margin(5e-5));
  CHECK(data.tool.R(1, 2) > 0.9); // the tool looks along +y

  // The raw table hangs down at q = 0; with the offset it stands up.
  vpArmKinematics::update(amor(), vpJointVector::Zero(7), data);
  CHECK(data.joint[3].p(2) == Approx(0.155 + 0.41946).margin(1e-9));
  CHECK(vpArmKinematics::link(amor(), data, 0).p.norm() == 0.);
  CHECK(difference(vpArmKinematics::link(amor(), data, 7) * amor().spec().tool, data.tool) < 1e-12);
}

TEST_CASE("Jacobians are the derivatives of the pose", "[kinematics]")
{
  auto rng = vpTestSupport::generator(3);
  CAPTURE(vpTestSupport::seed());
  const double h = 1e-6;
  for (const vpArmModel &arm : fixedAndLinkedArms(rng)) {
    const vpArmModel *model = &arm;
    CAPTURE(model->label());
    for (int problem = 0; problem < problemsOf(arm); ++problem) {
      const vpJointVector q = configuration(*model, rng);
      vpArmData data;
      vpArmKinematics::update(*model, q, data);
      double worst = 0., worstAnalytic = 0., worstPoint = 0.;
      const Eigen::Vector3d turn = vpSO3::log(data.tool.R);
      const vpArmJacobian analytic = vpArmKinematics::analytic(*model, data);
      for (int i = 0; i < model->size(); ++i) {
        const vpArmData before = at(*model, q, i, -h), after = at(*model, q, i, h);
        for (const vpArmFrame frame : frames) {
          const vpRigidTransform a = poseOf(*model, before, frame), b = poseOf(*model, after, frame);
          Eigen::Matrix<double, 6, 1> column;
          column << b.p - a.p, vpSO3::log(b.R * a.R.transpose());
          column /= 2. * h;
          if (frame != vpArmFrame::Base) {
            const Eigen::Matrix3d R = poseOf(*model, data, frame).R;
            column.head<3>() = (R.transpose() * column.head<3>()).eval();
            column.tail<3>() = (R.transpose() * column.tail<3>()).eval();
          }
          worst =
              std::max(worst, (vpArmKinematics::geometric(*model, data, frame).col(i) - column).cwiseAbs().maxCoeff());
        }
        if (turn.norm() < 3.1) { // the rotation vector jumps at pi
          Eigen::Matrix<double, 6, 1> column;
          column << after.tool.p - before.tool.p, vpSO3::log(after.tool.R) - vpSO3::log(before.tool.R);
          worstAnalytic = std::max(worstAnalytic, (analytic.col(i) - column / (2. * h)).cwiseAbs().maxCoeff());
        }
        for (int k = 0; k <= model->links(); ++k) {
          const auto point = [&](const vpArmData &from) {
            return k == model->links() ? from.tool.p : from.joint[static_cast<std::size_t>(k)].p;
          };
          const Eigen::Vector3d column = (point(after) - point(before)) / (2. * h);
          worstPoint = std::max(
              worstPoint, (vpArmKinematics::pointJacobian(*model, data, k).col(i) - column).cwiseAbs().maxCoeff());
        }
      }
      REQUIRE(worst < 1e-7);
      REQUIRE(worstAnalytic < 1e-6); // the logarithm near pi magnifies rounding
      REQUIRE(worstPoint < 1e-7);
    }
  }
}

TEST_CASE("Derivatives of the Jacobians are exact", "[kinematics]")
{
  auto rng = vpTestSupport::generator(4);
  CAPTURE(vpTestSupport::seed());
  const double h = 1e-5;
  double all = 0.;
  for (const vpArmModel &arm : fixedAndLinkedArms(rng)) {
    const vpArmModel *model = &arm;
    CAPTURE(model->label());
    for (int problem = 0; problem < problemsOf(arm); ++problem) {
      const vpJointVector q = configuration(*model, rng), velocity = randomVector(model->size(), rng);
      vpArmData data;
      vpArmKinematics::update(*model, q, data);
      for (const vpArmFrame frame : frames) {
        double worst = 0.;
        for (int k = 0; k < model->size(); ++k) {
          const vpArmJacobian difference = (vpArmKinematics::geometric(*model, at(*model, q, k, h), frame) -
                                            vpArmKinematics::geometric(*model, at(*model, q, k, -h), frame)) /
                                           (2. * h);
          worst =
              std::max(worst, (vpArmKinematics::derivative(*model, data, k, frame) - difference).cwiseAbs().maxCoeff());
        }
        vpArmData before, after;
        vpArmKinematics::update(*model, q - h * velocity, before);
        vpArmKinematics::update(*model, q + h * velocity, after);
        const vpArmJacobian rate =
            (vpArmKinematics::geometric(*model, after, frame) - vpArmKinematics::geometric(*model, before, frame)) /
            (2. * h);
        worst = std::max(worst,
                         (vpArmKinematics::timeDerivative(*model, data, velocity, frame) - rate).cwiseAbs().maxCoeff());
        REQUIRE(worst < 1e-7);
        all = std::max(all, worst);
      }
    }
  }
  std::cout << "largest difference of a Jacobian's derivative from central differences: " << all << '\n';
}

TEST_CASE("A camera or a tool on an earlier link moves as KDL's chain to there", "[kinematics]")
{
  auto rng = vpTestSupport::generator(6);
  CAPTURE(vpTestSupport::seed());
  const KDL::Chain whole = kdlAmor(false);
  double worst = 0.;
  for (int carrier = 1; carrier <= 7; ++carrier) {
    vpArmSpec spec = amor().spec();
    spec.cameraLink = carrier;
    spec.camera = {};
    const vpArmModel eye(spec);
    spec.cameraLink = -1;
    spec.toolLink = carrier;
    spec.tool = {};
    const vpArmModel hand(spec);
    KDL::Chain part;
    for (int i = 0; i < carrier; ++i) {
      part.addSegment(whole.getSegment(static_cast<unsigned int>(i)));
    }
    KDL::ChainFkSolverPos_recursive fk(part);
    KDL::ChainJntToJacSolver jac(part);
    KDL::JntArray q(part.getNrOfJoints());
    KDL::Jacobian J(part.getNrOfJoints());
    for (int problem = 0; problem < 200; ++problem) {
      const vpJointVector all = configuration(eye, rng);
      q.data = all.head(carrier);
      KDL::Frame pose;
      fk.JntToCart(q, pose);
      jac.JntToJac(q, J);
      vpArmData seen, held;
      vpArmKinematics::update(eye, all, seen);
      vpArmKinematics::update(hand, all, held);
      const vpRigidTransform fMc = vpArmKinematics::camera(eye, seen);
      vpArmJacobian own = vpArmKinematics::geometric(eye, seen, vpArmFrame::Camera);
      own.topRows<3>() = (fMc.R * own.topRows<3>()).eval();
      own.bottomRows<3>() = (fMc.R * own.bottomRows<3>()).eval();
      worst = std::max(worst, difference(fMc, held.tool));
      for (int i = 0; i < 3; ++i) {
        worst = std::max({worst, std::fabs(fMc.p(i) - pose.p(i)), std::fabs(fMc.R(i, 2) - pose.M(i, 2))});
      }
      for (const vpArmJacobian &ours : {own, held.J}) {
        worst = std::max(worst, (ours.leftCols(carrier) - J.data).cwiseAbs().maxCoeff());
        REQUIRE(ours.rightCols(7 - carrier).norm() == 0.);
      }
    }
  }
  std::cout << "camera or tool on each link: largest difference from KDL " << worst << '\n';
  CHECK(worst < 1e-12);
}

// Followers as joints of their own, at the coordinates that they should have.
TEST_CASE("An arm with followers is the arm of independent joints at their coordinates", "[kinematics]")
{
  auto rng = vpTestSupport::generator(5);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 500; ++problem) {
    CAPTURE(problem);
    const vpArmModel linked = randomLinkedArm(rng);
    vpArmSpec spec = linked.spec();
    std::vector<vpArmJointSpec> joints;
    const vpJointVector q = configuration(linked, rng);
    std::vector<double> coordinates;
    for (int i = 0; i <= linked.size(); ++i) {
      for (const vpArmFollower &f : spec.followers) {
        if (f.place == i) {
          vpArmJointSpec joint = spec.joints.front();
          joint.name = f.name;
          joint.type = f.type;
          joint.before = f.before;
          joint.after = f.after;
          joint.offset = 0.;
          joints.push_back(joint);
          coordinates.push_back(f.ratio * q(f.joint) + f.offset);
        }
      }
      if (i < linked.size()) {
        joints.push_back(spec.joints[static_cast<std::size_t>(i)]);
        coordinates.push_back(q(i));
      }
    }
    spec.joints = joints;
    spec.followers.clear();
    const vpArmModel free(spec);
    vpArmData a, b;
    vpArmKinematics::update(linked, q, a);
    vpArmKinematics::update(
        free, Eigen::Map<const Eigen::VectorXd>(coordinates.data(), static_cast<Eigen::Index>(coordinates.size())), b);
    REQUIRE(linked.links() == free.size());
    REQUIRE(difference(a.tool, b.tool) < 1e-12);
    REQUIRE(difference(vpArmKinematics::camera(linked, a), vpArmKinematics::camera(free, b)) < 1e-12);
    for (int i = 0; i <= free.size(); ++i) {
      REQUIRE(difference(vpArmKinematics::link(linked, a, i), vpArmKinematics::link(free, b, i)) < 1e-12);
    }
  }
}

TEST_CASE("Kinematics do not allocate", "[kinematics]")
{
  if (!vpTestSupport::canCountAllocations()) {
    vpTestSupport::skip("this build cannot count allocations");
    return;
  }
  const vpJointVector q = home();
  vpArmData data;
  double sum = 0.;
  const vpArmModel &model = amor();
  const unsigned long before = vpTestSupport::allocationCount();
  vpArmKinematics::update(model, q, data);
  for (const vpArmFrame frame : frames) {
    sum += vpArmKinematics::geometric(model, data, frame)(0, 0);
    sum += vpArmKinematics::timeDerivative(model, data, q, frame)(0, 0);
  }
  sum += vpArmKinematics::analytic(model, data)(0, 0) + vpArmKinematics::pointJacobian(model, data, 3)(0, 0);
  CHECK(vpTestSupport::allocationCount() == before);
  CHECK(std::isfinite(sum));
}

TEST_CASE("Poses go to ViSP and back", "[kinematics]")
{
  vpArmData data;
  vpArmKinematics::update(amor(), home(), data);
  const vpHomogeneousMatrix M = data.tool.toHomogeneous();
  CHECK(difference(vpRigidTransform::fromHomogeneous(M), data.tool) == 0.);
  CHECK(difference(data.tool * data.tool.inverse(), vpRigidTransform()) < 1e-14);
}
