/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Joints that follow others, and tools and cameras on any link.
#define VP_URDF_TEST "catchArmFollowers"
#include "vpCatch.h"
#include "vpKdlTestKit.h"
#include "vpRandomRow.h"

#include <visp3/manipulator/vpArmDynamics.h>
#include <visp3/manipulator/vpArmJson.h>

#include <kdl/chaindynparam.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include <algorithm>
#include <iostream>

using namespace vpUrdfTestKit;

TEST_CASE("Joints that mimic others are held, carried along or independent", "[urdf]")
{
  const std::string urdf =
      "<robot name='r'>" + link("base") + link("arm") + link("left") + link("right") + link("cam") +
      joint("j", "revolute", "base", "arm", good) + joint("l", "prismatic", "arm", "left", good) +
      joint("r", "prismatic", "arm", "right", good + "<mimic joint='l' multiplier='-0.5' offset='0.1'/>") +
      joint("c", "revolute", "base", "cam", good + "<mimic joint='j'/>") + "</robot>";
  vpArmUrdfSpec spec = toTip("arm");
  CHECK(load(urdf, spec).spec().uncovered == Sentences{"cam", "left", "right"});
  const auto isTold = [](const vpArmSpec &arm) {
    const std::string text = "joints beside the chain are not moved with the arm: ";
    return std::count(arm.warnings.begin(), arm.warnings.end(), text + "l, r") +
           std::count(arm.warnings.begin(), arm.warnings.end(), text + "r, l");
  };
  CHECK(isTold(load(urdf, spec).spec()) == 1);
  spec.held = {{"l", 0.4}};
  const vpArmSpec held = load(urdf, spec).spec();
  CHECK(isTold(held) == 0);
  CHECK(held.uncovered == Sentences{"cam"});
  REQUIRE(held.capsules.size() == 4);
  CHECK(held.capsules[2].from(2) == Approx(0.4));
  CHECK(held.capsules[3].from(2) == Approx(-0.1));
  spec.held.clear();
  spec.holdOthers = true; // one that mimics a joint of the chain moves with it
  CHECK(load(urdf, spec).spec().uncovered == Sentences{"cam"});
  spec.tip = "right";
  const vpArmModel finger = load(urdf, spec);
  CHECK(finger.size() == 2);
  CHECK(finger.lower()(1) == -0.9); // 0.1 - 0.5 * 2, 0.1 + 0.5 * 1
  CHECK(finger.upper()(1) == 0.6);
  CHECK(finger.spec().uncovered == Sentences{"cam", "left"});
  CHECK(errorOf(twoLinks(good + "<mimic joint='j'/>")).find("joint j mimics itself") != std::string::npos);
}

// Three joints a, b, c in a row between base and tip, and one beside them.
std::string row(const std::string &a, const std::string &b, const std::string &c,
                const std::string &typeOfB = "revolute")
{
  return "<robot name='r'>" + link("base") + link("one", ball + mass) + link("two", ball + mass) +
         link("tip", ball + mass) + link("out") + joint("a", "revolute", "base", "one", "<origin xyz='0 0 1'/>" + a) +
         joint("b", typeOfB, "one", "two", "<origin xyz='1 0 0'/>" + b) +
         joint("c", "revolute", "two", "tip", "<origin xyz='0 1 0'/>" + c) +
         joint("out", "revolute", "base", "out", good) + "</robot>";
}

TEST_CASE("Joints that mimic another one of the chain follow it, before and behind it", "[urdf]")
{
  const std::string wide = limit("lower='-9' upper='9' velocity='9' effort='4'"),
                    friction = "<dynamics damping='2' friction='3'/>";
  const std::string of = "<mimic joint='c' multiplier='-2' offset='0.5'/>";
  const vpArmModel arm =
      load(row(wide + of + friction, wide + "<mimic joint='a' multiplier='0.5'/>", good + friction), toTip("tip"));
  REQUIRE(arm.size() == 1);
  REQUIRE(arm.links() == 3);
  CHECK(arm.spec().joints[0].name == "c");
  const std::vector<vpArmFollower> &followers = arm.spec().followers;
  REQUIRE(followers.size() == 2);
  CHECK(followers[0].name == "a");
  CHECK(followers[0].place == 0);
  CHECK(followers[0].ratio == -2.);
  CHECK(followers[0].offset == 0.5);
  CHECK(followers[1].ratio == -1.); // half of a
  CHECK(followers[1].offset == 0.25);
  CHECK(arm.lower()(0) == -1.);
  CHECK(arm.upper()(0) == 2.);
  CHECK(arm.velocity()(0) == 3.);
  CHECK(arm.spec().joints[0].viscous == 2. + 4. * 2.);
  CHECK(arm.spec().joints[0].coulomb == 3. + 2. * 3.);
  CHECK(arm.spec().bodies.back().link == 3);
  CHECK(arm.hasMasses());
  vpArmData data;
  vpArmKinematics::update(arm, vector({0.3}), data);
  const double a = -2. * 0.3 + 0.5, b = 0.5 * a; // of a and b
  const Eigen::Vector3d tip(std::cos(a) - std::sin(a + b), std::sin(a) + std::cos(a + b), 1.);
  CHECK((data.tool.p - tip).norm() < 1e-12);
  CHECK(std::any_of(arm.spec().warnings.begin(), arm.spec().warnings.end(), [](const std::string &warning) {
    return warning == "joints of the chain that follow another one by a fixed ratio: a follows c, b follows c";
  }));

  // Limits of a follower hold, and those of its velocity.
  const std::string narrow = limit("lower='-0.2' upper='0.8' velocity='1' effort='4'");
  const vpArmModel limited =
      load(row(good, narrow + "<mimic joint='a' multiplier='-0.5' offset='0.1'/>", good), toTip("tip"));
  REQUIRE(limited.size() == 2);
  CHECK(limited.lower()(0) == Approx(-1.)); // -0.5 a + 0.1 <= 0.8 from -1.4 on
  CHECK(limited.upper()(0) == Approx(0.6)); // -0.5 a + 0.1 >= -0.2 to there
  CHECK(limited.velocity()(0) == Approx(2.));
  CHECK(limited.lower()(1) == -1.);

  // A continuous joint whose follower has limits has some, too.
  const vpArmModel turning =
      load("<robot name='r'>" + link("base") + link("one") + link("two") +
               joint("a", "continuous", "base", "one", "<axis xyz='0 0 1'/>") +
               joint("b", "prismatic", "one", "two", good + "<mimic joint='a' multiplier='0.1'/>") + "</robot>",
           toTip("two"));
  CHECK(turning.lower()(0) == Approx(-10.));
  CHECK(turning.upper()(0) == Approx(20.));
  CHECK_FALSE(turning.isContinuous(0));

  // Two that mimic the same joint beside the chain: the second follows the first.
  const std::string out = "<mimic joint='out' multiplier='";
  const vpArmModel twins = load(row(good, wide + out + "2' offset='1'/>", wide + out + "-6'/>"), toTip("tip"));
  REQUIRE(twins.size() == 2);
  REQUIRE(twins.spec().followers.size() == 1);
  CHECK(twins.spec().joints[1].name == "b");
  CHECK(twins.spec().followers[0].ratio == -3.);
  CHECK(twins.spec().followers[0].offset == 3.);
  CHECK(twins.lower()(1) == Approx(-1.)); // of out, 2 q + 1, and of c, -3 b + 3 within 9
  CHECK(twins.upper()(1) == Approx(4.));

  // The ratio 0 holds a joint; one that is held holds what mimics it.
  CHECK(load(row(good, wide + "<mimic joint='a' multiplier='0' offset='0.3'/>", good), toTip("tip")).links() == 2);
  vpArmUrdfSpec held = toTip("tip");
  held.held = {{"a", 0.3}};
  CHECK(load(row(good, wide + "<mimic joint='a'/>", good), held).links() == 1);
  vpArmUrdfSpec home = toTip("tip");
  home.home = vector({0.1, 0.2});
  CHECK(load(row(good, wide + "<mimic joint='a'/>", good), home).home()(1) == 0.2);
}

namespace
{
// Coordinates of all moving joints of a chain as ratios * q + offsets, as urdfdom's tree says it.
struct Linkage {
  Linkage(const urdf::ModelInterface &tree, const KDL::Chain &chain, const vpArmModel &model)
    : ratios(Eigen::MatrixXd::Zero(chain.getNrOfJoints(), model.size())),
      offsets(Eigen::VectorXd::Zero(chain.getNrOfJoints()))
  {
    for (const KDL::Segment &segment : chain.segments) {
      if (segment.getJoint().getType() == KDL::Joint::None) {
        continue;
      }
      const auto row = static_cast<Eigen::Index>(joints.size());
      joints.push_back(tree.getJoint(segment.getJoint().getName()));
      urdf::JointConstSharedPtr leader = joints.back();
      double ratio = 1.;
      for (; leader->mimic; leader = tree.getJoint(leader->mimic->joint_name)) {
        offsets(row) += ratio * leader->mimic->offset;
        ratio *= leader->mimic->multiplier;
      }
      for (int i = 0; i < model.size(); ++i) {
        if (model.spec().joints[static_cast<std::size_t>(i)].name == leader->name) {
          ratios(row, i) = ratio;
        }
      }
    }
  }
  std::vector<urdf::JointConstSharedPtr> joints;
  Eigen::MatrixXd ratios;
  Eigen::VectorXd offsets;
};

// All joints of the chain are within their limits exactly where those of the arm are within theirs.
void checkLimits(const vpArmModel &model, const Linkage &all)
{
  for (int i = 0; i < model.size(); ++i) {
    double lower = -std::numeric_limits<double>::infinity(), upper = -lower, velocity = upper;
    double viscous = 0., coulomb = 0.;
    for (std::size_t k = 0; k < all.joints.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const double ratio = all.ratios(row, i), offset = all.offsets(row);
      if (ratio == 0.) {
        continue;
      }
      const urdf::Joint &joint = *all.joints[k];
      velocity = std::min(velocity, joint.limits->velocity / std::fabs(ratio));
      viscous += ratio * ratio * joint.dynamics->damping;
      coulomb += std::fabs(ratio) * joint.dynamics->friction;
      if (joint.type != urdf::Joint::CONTINUOUS) {
        const double a = (joint.limits->lower - offset) / ratio, b = (joint.limits->upper - offset) / ratio;
        lower = std::max(lower, std::min(a, b));
        upper = std::min(upper, std::max(a, b));
      }
    }
    const vpArmJointSpec &joint = model.spec().joints[static_cast<std::size_t>(i)];
    CAPTURE(joint.name);
    REQUIRE(model.isContinuous(i) == std::isinf(lower));
    REQUIRE((model.isContinuous(i) || std::fabs(model.lower()(i) - lower) < 1e-12));
    REQUIRE((model.isContinuous(i) || std::fabs(model.upper()(i) - upper) < 1e-12));
    REQUIRE(model.velocity()(i) == Approx(velocity).epsilon(1e-12));
    REQUIRE(joint.viscous == Approx(viscous).epsilon(1e-12));
    REQUIRE(joint.coulomb == Approx(coulomb).epsilon(1e-12));
  }
}

// Largest difference of pose, Jacobian, inertia and torques in one state from those of the independent joints.
double differenceFromKdl(const vpArmModel &model, const KDL::Chain &chain, const Linkage &all, std::mt19937_64 &rng)
{
  const unsigned int links = chain.getNrOfJoints();
  const vpJointVector q = configuration(model, rng), velocity = randomVector(model.size(), rng);
  KDL::JntArray at(links), rate(links), torque(links);
  at.data = all.ratios * q + all.offsets;
  rate.data = all.ratios * velocity;
  KDL::Frame pose;
  KDL::Jacobian J(links);
  KDL::ChainFkSolverPos_recursive(chain).JntToCart(at, pose);
  KDL::ChainJntToJacSolver(chain).JntToJac(at, J);
  vpArmData data;
  vpArmKinematics::update(model, q, data);
  double worst = (data.J - J.data * all.ratios).cwiseAbs().maxCoeff();
  for (int i = 0; i < 3; ++i) {
    worst = std::max(worst, std::fabs(data.tool.p(i) - pose.p(i)));
    for (int j = 0; j < 3; ++j) {
      worst = std::max(worst, std::fabs(data.tool.R(i, j) - pose.M(i, j)));
    }
  }
  KDL::ChainDynParam oracle(chain, KDL::Vector(0., 0., -9.81));
  KDL::JntSpaceInertiaMatrix inertia(static_cast<int>(links));
  vpArmDynamics dynamics(model);
  vpJointMatrix M;
  vpJointVector term;
  oracle.JntToMass(at, inertia);
  dynamics.inertia(q, M);
  worst = std::max(worst, (M - all.ratios.transpose() * inertia.data * all.ratios).cwiseAbs().maxCoeff());
  oracle.JntToCoriolis(at, rate, torque);
  dynamics.coriolis(q, velocity, term);
  worst = std::max(worst, (term - all.ratios.transpose() * torque.data).cwiseAbs().maxCoeff());
  oracle.JntToGravity(at, torque);
  dynamics.gravity(q, term);
  return std::max(worst, (term - all.ratios.transpose() * torque.data).cwiseAbs().maxCoeff());
}
} // namespace

TEST_CASE("Random URDFs with mimic joints in the chain are KDL's chain of independent joints", "[urdf]")
{
  auto rng = vpTestSupport::generator(7);
  CAPTURE(vpTestSupport::seed());
  int followers = 0;
  double worst = 0.;
  for (int problem = 0; problem < 300; ++problem) {
    const std::string urdf = randomRow(rng);
    CAPTURE(problem, urdf);
    const urdf::ModelInterfaceSharedPtr tree = urdf::parseURDF(urdf);
    REQUIRE(tree);
    urdf::LinkConstSharedPtr tip = tree->getRoot();
    while (!tip->child_links.empty()) {
      tip = tip->child_links.front();
    }
    const KDL::Chain chain = kdlChain(*tree, "l0", tip->name);
    const vpArmModel model = load(urdf);
    REQUIRE(model.links() == static_cast<int>(chain.getNrOfJoints()));
    const Linkage all(*tree, chain, model);
    REQUIRE((all.ratios.array() != 0.).rowwise().count().isConstant(1));
    checkLimits(model, all);
    for (int state = 0; state < 5; ++state) {
      worst = std::max(worst, differenceFromKdl(model, chain, all, rng));
    }
    followers += model.links() - model.size();
  }
  std::cout << followers << " followers in 300 rows: largest difference from KDL " << worst << '\n';
  CHECK(followers > 300);
  CHECK(worst < 1e-10);
}

TEST_CASE("Tool and camera may be on any link of the chain", "[urdf]")
{
  const std::string urdf = row(good, good, good);
  vpArmUrdfSpec spec = toTip("tip");
  spec.camera = "one";
  const vpArmModel arm = load(urdf, spec);
  CHECK(arm.cameraLink() == 1);
  CHECK(arm.toolLink() == 3);
  const vpJointVector q = vector({0.3, 0.4, 0.5});
  vpArmData data;
  vpArmKinematics::update(arm, q, data);
  CHECK((vpArmKinematics::camera(arm, data).p - Eigen::Vector3d(0., 0., 1.)).norm() < 1e-12);
  const vpArmJacobian J = vpArmKinematics::geometric(arm, data, vpArmFrame::Camera);
  CHECK(J.col(0)(5) == Approx(1.));
  CHECK(J.rightCols(2).norm() == 0.);
  spec.tool = "two";
  const vpArmModel two = load(urdf, spec);
  CHECK(two.toolLink() == 2);
  vpArmKinematics::update(two, q, data);
  CHECK((data.tool.p - Eigen::Vector3d(std::cos(0.3), std::sin(0.3), 1.)).norm() < 1e-12);
  CHECK(data.J.col(2).norm() == 0.);
  spec.camera = "two"; // with the tool
  CHECK(load(urdf, spec).spec().cameraLink == -1);
  spec.camera = "base";
  CHECK(errorOf(urdf, spec).find("camera link base is not below a moving joint of the arm") != std::string::npos);
  spec.tool = "out";
  CHECK(errorOf(urdf, spec).find("joint out between the arm and the tool link out is not fixed") != std::string::npos);
}

TEST_CASE("A table of DH may have tool and camera on any link", "[files]")
{
  const auto table = [](const std::string &rest) {
    const std::string row =
        R"(, "type": "revolute", "a_m": 1, "alpha_deg": 0, "d_m": 0, "lower_deg": -90, "upper_deg": 90})";
    const File file("own.json", R"({"name": "plane", "joints": [{"name": "a")" + row + R"(, {"name": "b")" + row +
                                    R"(, {"name": "c")" + row + "], " + rest + "}");
    return vpLoadArmJson(file.name());
  };
  const std::string at = R"("translation_m": [0, 0, 0.5], "link": )";
  const vpArmModel arm = table(R"("tool": {)" + at + R"(2}, "camera": {)" + at + "1}");
  CHECK(arm.toolLink() == 2);
  CHECK(arm.cameraLink() == 1);
  vpArmData data;
  vpArmKinematics::update(arm, vector({0.3, 0.4, 0.5}), data);
  const Eigen::Vector3d first(std::cos(0.3), std::sin(0.3), 0.5), second(std::cos(0.7), std::sin(0.7), 0.);
  CHECK((vpArmKinematics::camera(arm, data).p - first).norm() < 1e-14);
  CHECK((data.tool.p - first - second).norm() < 1e-14);
  CHECK(table(R"("tool": {)" + at + "2}").cameraLink() == 2); // fixed to the end effector
  for (const char *link : {"0", "1.5", "-1"}) {
    CHECK(errorOf([&] {
            static_cast<void>(table(R"("camera": {)" + at + link + "}"));
          }).find(std::string("camera.link is ") + link + ", must be a whole number, at least 1") != std::string::npos);
  }
  CHECK(errorOf([&] { static_cast<void>(table(R"("tool": {)" + at + "4}")); }).find("4") != std::string::npos);
}

TEST_CASE("The camera moves with a link of the arm, or is refused", "[urdf]")
{
  const std::string urdf = "<robot name='r'>" + link("base") + link("arm") + link("tip") + link("eye") + link("lens") +
                           joint("j", "revolute", "base", "arm", good) + joint("k", "revolute", "arm", "tip", good) +
                           joint("e", "fixed", "arm", "eye") +
                           joint("l", "prismatic", "tip", "lens", "<origin xyz='1 0 0'/>" + good) + "</robot>";
  vpArmUrdfSpec spec = toTip("tip");
  spec.camera = "eye";
  CHECK(load(urdf, spec).cameraLink() == 1);
  spec.camera = "lens";
  CHECK(errorOf(urdf, spec).find("joint l between the arm and the camera link lens is not fixed") != std::string::npos);
  spec.held = {{"l", 0.5}};
  CHECK((load(urdf, spec).spec().camera.p - Eigen::Vector3d(1., 0., 0.5)).norm() < 1e-12);
}
