/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Arms against MuJoCo, which reads the same URDFs by itself: frames of all links, inertia and bias, motions, contacts.
#define VP_URDF_TEST "catchMujocoOracle"
#include "vpCaseFile.h"
#include "vpMujocoArm.h"
#include "vpRandomRow.h"

#include <visp3/avoidance/vpCollisionScene.h>
#include <visp3/avoidance/vpFclChecker.h>
#include <visp3/core/vpColVector.h>
#include <visp3/manipulator/vpArmDynamics.h>
#include <visp3/simulation/vpSimulatedArm.h>

#include <Eigen/Geometry>

#include <cmath>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>

using namespace vpTestArms;

namespace
{
const char *const robots[] = {"robots/fetch.urdf",
                              "robots/fr3.urdf",
                              "robots/franka_panda.urdf",
                              "robots/iiwa14_primitive_collision.urdf",
                              "robots/irb120_3_58.urdf",
                              "robots/kinovaGen3.urdf",
                              "robots/kinovaJacoJ2S7S300.urdf",
                              "robots/kr6r900sixx.urdf",
                              "robots/lrmate200id.urdf",
                              "robots/panda.urdf",
                              "robots/pr2.urdf",
                              "robots/puma560_robot.urdf",
                              "example-robot-data/robots/kinova_description/robots/kinova.urdf",
                              "example-robot-data/robots/panda_description/urdf/panda.urdf",
                              "example-robot-data/robots/tiago_description/robots/tiago_no_hand.urdf",
                              "example-robot-data/robots/ur_description/urdf/ur5_robot.urdf"};

double difference(const vpRigidTransform &a, const vpRigidTransform &b)
{
  return std::max((a.p - b.p).cwiseAbs().maxCoeff(), (a.R - b.R).cwiseAbs().maxCoeff());
}

//! Largest difference of a frame in one configuration.
double frameDifference(const vpArmModel &model, const vpArmData &data, const vpMujoco::Arm &oracle,
                       const std::string &leaf)
{
  double worst = difference(data.tool, oracle.pose(leaf));
  for (int i = 1; i <= model.links() && !model.spec().links.empty(); ++i) {
    const std::string &name = model.spec().links[static_cast<std::size_t>(i - 1)].name;
    worst = std::max(worst, difference(vpArmKinematics::link(model, data, i), oracle.pose(name)));
  }
  return worst;
}
} // namespace

TEST_CASE("Frames of all links are those of MuJoCo", "[mujoco]")
{
  auto rng = vpTestSupport::generator(961);
  CAPTURE(vpTestSupport::seed());
  int all = 0, files = 0;
  for (const char *name : robots) {
    const std::string file = vpTestSupport::caseFile(name);
    if (file.empty()) {
      continue;
    }
    vpMujoco::Arm oracle(file);
    double worst = 0.;
    int chains = 0;
    for (const std::string &leaf : oracle.leaves()) {
      vpArmUrdfSpec spec;
      spec.tip = leaf;
      try {
        const vpArmModel model = vpLoadArmUrdf(file, spec);
        vpArmData data;
        for (int pose = 0; pose < 1000; ++pose) {
          const vpJointVector q = configuration(model, rng);
          vpArmKinematics::forward(model, q, data);
          oracle.place(model, q);
          worst = std::max(worst, frameDifference(model, data, oracle, leaf));
        }
        ++chains;
      }
      catch (const vpException &e) {
        std::cout << name << ", " << leaf << " is left out: " << e.getStringMessage() << '\n';
      }
    }
    all += chains;
    files += chains > 0 ? 1 : 0;
    std::cout << name << ": " << chains << " of " << oracle.leaves().size() << " chains, frames differ by at most "
              << worst << " m or 1\n";
    CAPTURE(name, chains, worst);
    CHECK(worst < 1e-12);
  }
  std::cout << all << " chains of " << files << " robots\n";
}

namespace
{
//! Largest differences of M and of the bias in 100 random states, relative to the largest number of each.
std::pair<double, double> dynamicsDifference(const vpArmModel &model, vpMujoco::Arm &oracle, std::mt19937_64 &rng)
{
  vpArmDynamics dynamics(model);
  double inertia = 0., bias = 0.;
  for (int state = 0; state < 100; ++state) {
    const vpJointVector q = configuration(model, rng), velocity = randomVector(model.size(), rng);
    vpJointMatrix M, other;
    vpJointVector coriolis, gravity, torque;
    dynamics.inertia(q, M);
    dynamics.coriolis(q, velocity, coriolis);
    dynamics.gravity(q, gravity);
    oracle.place(model, q);
    oracle.dynamics(model, velocity, other, torque);
    inertia = std::max(inertia, (M - other).cwiseAbs().maxCoeff() / M.cwiseAbs().maxCoeff());
    const double scale = std::max(1., torque.cwiseAbs().maxCoeff());
    bias = std::max(bias, (coriolis + gravity - torque).cwiseAbs().maxCoeff() / scale);
  }
  return {inertia, bias};
}

//! The chain to a leaf, if its masses are known and MuJoCo takes them, too.
std::optional<vpArmModel> massive(const std::string &file, const std::string &leaf)
{
  vpArmUrdfSpec spec;
  spec.tip = leaf;
  try {
    vpArmModel model = vpLoadArmUrdf(file, spec);
    const vpArmDynamics probe(model);
    return model;
  }
  catch (const vpException &) {
    return std::nullopt;
  }
}
} // namespace

TEST_CASE("Inertia, gravity and velocity torques are those of MuJoCo where masses are known", "[mujoco]")
{
  auto rng = vpTestSupport::generator(962);
  CAPTURE(vpTestSupport::seed());
  int compared = 0, files = 0;
  for (const char *name : robots) {
    const std::string file = vpTestSupport::caseFile(name);
    if (file.empty()) {
      continue;
    }
    ++files;
    for (const std::string &leaf : vpMujoco::Arm(file).leaves()) {
      if (const auto model = massive(file, leaf)) {
        vpMujoco::Arm oracle(file);
        if (oracle.changesMassesOf(*model) || oracle.hasFollowerBeside(*model)) {
          continue;
        }
        oracle.keepMassesOf(*model);
        const auto [inertia, bias] = dynamicsDifference(*model, oracle, rng);
        CAPTURE(name, leaf, inertia, bias);
        CHECK(inertia < 1e-7); // MuJoCo brings inertias to their principal axes in steps: 1e-12 where they have no
        CHECK(bias < 1e-7);    // products, up to 4e-8 where they have
        std::cout << name << ", " << leaf << ": M differs by " << inertia << ", C q' + g by " << bias << '\n';
        ++compared;
      }
    }
  }
  CHECK((files == 0 || compared >= 10));
}

TEST_CASE("Random arms with mimic joints in the chain have MuJoCo's frames and dynamics", "[mujoco]")
{
  auto rng = vpTestSupport::generator(965);
  CAPTURE(vpTestSupport::seed());
  double frames = 0., inertia = 0., bias = 0.;
  int followers = 0;
  for (int problem = 0; problem < 50; ++problem) {
    const std::string urdf = vpUrdfTestKit::randomRow(rng);
    const vpUrdfTestKit::File file("row.urdf", urdf);
    CAPTURE(problem, urdf);
    const vpArmModel model = vpLoadArmUrdf(file.name());
    vpMujoco::Arm oracle(file.name());
    REQUIRE(oracle.leaves().size() == 1);
    vpArmData data;
    for (int pose = 0; pose < 20; ++pose) {
      const vpJointVector q = configuration(model, rng);
      vpArmKinematics::forward(model, q, data);
      oracle.place(model, q);
      frames = std::max(frames, frameDifference(model, data, oracle, oracle.leaves().front()));
    }
    const auto [ofInertia, ofBias] = dynamicsDifference(model, oracle, rng);
    inertia = std::max(inertia, ofInertia);
    bias = std::max(bias, ofBias);
    followers += model.links() - model.size();
  }
  std::cout << followers << " followers in 50 rows: frames differ by at most " << frames << ", M by " << inertia
            << ", C q' + g by " << bias << '\n';
  CHECK(followers > 50);
  CHECK(frames < 1e-12);
  CHECK(inertia < 1e-10); // no products of inertia
  CHECK(bias < 1e-10);
}

TEST_CASE("A simulated arm moves as MuJoCo integrates its torques", "[mujoco]")
{
  auto rng = vpTestSupport::generator(963);
  CAPTURE(vpTestSupport::seed());
  const std::string file =
      vpTestSupport::caseFile("robots/iiwa14_primitive_collision.urdf"); // damping, no Coulomb friction
  if (file.empty()) {
    return;
  }
  vpMujoco::Arm oracle(file);
  vpArmUrdfSpec urdf;
  urdf.tip = oracle.leaves().front();
  urdf.acceleration = 10.;
  const vpArmModel model = vpLoadArmUrdf(file, urdf);
  for (const vpArmJointSpec &joint : model.spec().joints) {
    CHECK(oracle.friction(joint.name) == std::pair(joint.viscous, joint.coulomb));
  }
  vpSimulatedArmSpec spec;
  spec.redundancy.period = spec.drives.period = 0.001; // a torque for each step
  double way = 0., worst = 0.;
  for (const vpDriveReference reference : {vpDriveReference::Integrated, vpDriveReference::Measured}) {
    spec.drives.reference = reference;
    spec.start = configuration(model, rng, 0.35);
    vpSimulatedArm robot(model, spec);
    robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
    robot.setSamplingTime(0.001);
    oracle.place(model, spec.start);
    vpColVector velocity(7);
    for (int k = 0; k < 2000; ++k) {
      for (unsigned int i = 0; i < 7 && k % 250 == 0; ++i) {
        velocity[i] = uniform(rng, -0.6, 0.6);
      }
      robot.setVelocity(vpRobot::JOINT_STATE, velocity);
      const vpSimulatedArmState state = robot.getState();
      oracle.step(model, state.torque, 0.001);
      worst = std::max(worst, (state.q - oracle.configuration(model)).cwiseAbs().maxCoeff());
      way = std::max(way, (state.q - spec.start).cwiseAbs().maxCoeff());
    }
  }
  std::cout << "2000 steps, up to " << way << " rad of way: off by at most " << worst << " rad\n";
  CHECK(way > 0.1);
  // Rounding, and the velocity of 1e-10 at which a joint sticks, grow as a pendulum falls.
  CHECK(worst < 1e-5);
}

namespace
{
//! What the scene says of two links.
struct Verdict {
  double clearance = 0.; //!< Least clearance of their capsules, m.
  bool checked = false;  //!< The scene checks such a pair.
};

Verdict between(const vpCollisionScene &scene, const vpCollisionData &data, int first, int second)
{
  Verdict verdict{std::numeric_limits<double>::infinity(), false};
  for (const vpSelfPair &pair : scene.selfPairs()) {
    const int a = scene.capsule(pair.first).link, b = scene.capsule(pair.second).link;
    if ((a == first && b == second) || (a == second && b == first)) {
      verdict.checked = true;
      verdict.clearance = std::min(verdict.clearance, scene.selfPair(data, pair.first, pair.second).distance);
    }
  }
  return verdict;
}

//! An arm of primitives in both worlds, with a ball and a block.
class Contacts
{
public:
  Contacts(const std::string &file, const vpArmUrdfSpec &urdf)
    : m_oracle(file,
               [] {
                 vpMujoco::Options options;
                 options.obstacles = true;
                 return options;
               }()),
      m_model(vpLoadArmUrdf(file, urdf)), m_scene(m_model, specOf(m_model))
  {
    m_links.emplace_back("");
    for (const vpArmLinkSpec &link : m_model.spec().links) {
      m_links.push_back(link.name);
    }
  }

  //! A random configuration with random obstacles, which are near the arm as often as not.
  void draw(std::mt19937_64 &rng)
  {
    m_q = configuration(m_model, rng);
    m_oracle.place(m_model, m_q);
    for (const char *name : {"ball", "block"}) {
      vpRigidTransform pose;
      pose.R = Eigen::Quaterniond(Eigen::Vector4d(randomVector(4, rng))).normalized().toRotationMatrix();
      const Eigen::Vector3d size = Eigen::Vector3d::NullaryExpr([&] { return uniform(rng, 0.03, 0.15); });
      vpArmData frames;
      vpArmKinematics::forward(m_model, m_q, frames);
      const int near = std::uniform_int_distribution<int>(1, m_model.links())(rng);
      pose.p = vpArmKinematics::link(m_model, frames, near).p +
               Eigen::Vector3d::NullaryExpr([&] { return uniform(rng, -0.35, 0.35); });
      m_oracle.obstacle(name, pose, size);
      m_scene.remove(m_scene.find(name));
      vpCollisionObject object;
      object.name = name;
      object.shape = name[1] == 'a' ? vpCollisionShape::sphere(size(0)) : vpCollisionShape::box(2. * size);
      object.pose = pose;
      m_scene.add(object);
    }
    m_scene.place(m_q, m_data);
    m_contacts = m_oracle.contacts();
  }

  //! Every pair that touches in MuJoCo must touch here; counts those that we do not check.
  void requireSeen()
  {
    for (const vpMujoco::Contact &contact : m_contacts) {
      CAPTURE(m_q.transpose(), contact.first, contact.second, contact.distance);
      if (contact.distance > 0.) {
        continue;
      }
      ++touching;
      const int a = linkOf(contact.first), b = linkOf(contact.second);
      const int object = m_scene.find(isObstacle(contact.first) ? contact.first : contact.second);
      if (object < 0) {
        const Verdict verdict = between(m_scene, m_data, a, b);
        unchecked += verdict.checked ? 0 : 1;
        REQUIRE((!verdict.checked || verdict.clearance <= 1e-6));
      }
      else if (std::max(a, b) > 0) {
        REQUIRE(clearanceOf(std::max(a, b), object, false) <= 1e-6);
      }
    }
  }

  //! An obstacle that reaches the axis of a capsule, which lies inside of the primitive, must touch in MuJoCo.
  void requireReal()
  {
    for (int link = 1; link <= m_model.links(); ++link) {
      for (int object = 0; object < m_scene.objectCount(); ++object) {
        const std::string &name = m_scene.object(object).name;
        const bool found = std::any_of(m_contacts.begin(), m_contacts.end(), [&](const vpMujoco::Contact &c) {
          return (c.first == name && linkOf(c.second) == link) || (c.second == name && linkOf(c.first) == link);
        });
        CAPTURE(m_q.transpose(), link, name, clearanceOf(link, object, true));
        deep += clearanceOf(link, object, true) < -1e-6 ? 1 : 0;
        REQUIRE((found || clearanceOf(link, object, true) > -1e-6));
      }
    }
  }

  //! Scene and FCL agree.
  void requireAgreement()
  {
    vpFclChecker fcl(m_scene);
    const bool ours = m_scene.inCollision(m_data), byFcl = fcl.inCollision(m_q, 0.);
    CAPTURE(m_q.transpose(), ours, byFcl, m_scene.clearance(m_data).distance);
    REQUIRE((ours == byFcl || std::fabs(m_scene.clearance(m_data).distance) < 1e-3)); // FCL's boxes err by 1 mm
  }

  long touching = 0, unchecked = 0, deep = 0;

private:
  static vpCollisionSceneSpec specOf(const vpArmModel &model)
  {
    vpCollisionSceneSpec spec;
    spec.ignoredBodies = model.spec().uncovered;
    for (const char *name : {"ball", "block"}) {
      spec.objects.emplace_back();
      spec.objects.back().name = name;
    }
    return spec;
  }
  static bool isObstacle(const std::string &body) { return body == "ball" || body == "block"; }
  int linkOf(const std::string &body) const
  {
    const std::string carrier = isObstacle(body) ? "" : m_oracle.carrier(body, m_links);
    return static_cast<int>(std::find(m_links.begin(), m_links.end(), carrier) - m_links.begin());
  }
  //! Least clearance of the capsules of a link, or of their axes.
  double clearanceOf(int link, int object, bool axis) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < m_scene.capsuleCount(); ++i) {
      if (m_scene.capsule(i).link == link) {
        const double margin = axis ? m_scene.capsule(i).radius : 0.;
        least = std::min(least, m_scene.pair(m_data, i, object).distance + margin);
      }
    }
    return least;
  }

  vpMujoco::Arm m_oracle;
  vpArmModel m_model;
  vpCollisionScene m_scene;
  vpCollisionData m_data;
  vpJointVector m_q;
  std::vector<std::string> m_links; // by number; the base has none
  std::vector<vpMujoco::Contact> m_contacts;
};
} // namespace

TEST_CASE("What touches in MuJoCo touches here, and what is deep here touches in MuJoCo", "[mujoco]")
{
  auto rng = vpTestSupport::generator(964);
  CAPTURE(vpTestSupport::seed());
  vpArmUrdfSpec six;
  six.tip = "tool";
  vpArmUrdfSpec iiwa;
  iiwa.tip = "iiwa_link_ee";
  const std::pair<std::string, vpArmUrdfSpec> arms[] = {
      {std::string(VISP_DIRECT_DATA_DIR) + "/robot/generic-6r.urdf", six},
      {vpTestSupport::caseFile("robots/iiwa14_primitive_collision.urdf"), iiwa}};
  for (const auto &[file, urdf] : arms) {
    if (file.empty()) {
      continue;
    }
    Contacts both(file, urdf);
    for (int problem = 0; problem < 2000; ++problem) {
      both.draw(rng);
      both.requireSeen();
      both.requireReal();
      if (problem % 10 == 0) {
        both.requireAgreement();
      }
    }
    std::cout << urdf.tip << ": " << both.touching << " contacts of MuJoCo, " << both.unchecked
              << " of them between links that the scene does not check; " << both.deep << " deep contacts here\n";
    CHECK(both.touching > 500);
    CHECK(both.deep > 100);
  }
}

TEST_CASE("MuJoCo takes the meshes of public arms", "[mujoco]")
{
  const std::pair<const char *, std::vector<const char *>> arms[] = {
      {"panda_description/urdf/panda.urdf", {"panda_link2", "panda_link4", "panda_link6", "panda_hand"}},
      {"ur_description/urdf/ur5_robot.urdf", {"shoulder_link", "forearm_link", "wrist_1_link", "wrist_3_link"}}};
  for (const auto &[name, links] : arms) {
    const std::string file = vpTestSupport::caseFile(std::string("example-robot-data/robots/") + name);
    if (file.empty()) {
      continue;
    }
    const std::string folder = file.substr(0, file.rfind("example-robot-data/"));
    vpMujoco::Options options;
    options.obstacles = true;
    options.mesh = [&folder](const std::string &mesh) {
      std::ifstream stream(folder + mesh.substr(std::string("package://").size()), std::ios::binary);
      std::ostringstream content;
      content << stream.rdbuf();
      return content.str();
    };
    vpMujoco::Arm oracle(file, options);
    for (const char *link : links) {
      oracle.obstacle("ball", {Eigen::Matrix3d::Identity(), oracle.pose(link).p}, {0.1, 0., 0.});
      const std::vector<vpMujoco::Contact> contacts = oracle.contacts();
      CAPTURE(name, link, contacts.size());
      CHECK(std::any_of(contacts.begin(), contacts.end(), [link = std::string(link)](const vpMujoco::Contact &c) {
        return (c.first == "ball" && c.second == link) || (c.second == "ball" && c.first == link);
      }));
    }
  }
}
