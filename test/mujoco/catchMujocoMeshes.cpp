/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Exact checks of arms with meshes against MuJoCo's contacts and FCL's: who sees what.
#include "vpExactOracle.h"
#include "vpMeshArms.h"
#include "vpMujocoArm.h"

#include <visp3/avoidance/vpExactChecker.h>

#include <fstream>
#include <iostream>
#include <set>
#include <sstream>

using namespace vpMeshArms;

namespace
{
//! MuJoCo's world of a robot with its meshes.
std::unique_ptr<vpMujoco::Arm> mujocoOf(const Robot &robot)
{
  const std::string file = fileOf(robot.urdf), folder = file.substr(0, file.rfind("example-robot-data/"));
  vpMujoco::Options options;
  options.obstacles = true;
  options.mesh = [folder](const std::string &mesh) {
    std::ifstream stream(folder + mesh.substr(std::string("package://").size()), std::ios::binary);
    std::ostringstream content;
    content << stream.rdbuf();
    return content.str();
  };
  return std::make_unique<vpMujoco::Arm>(file, options);
}

//! The robot and its two obstacles in all three worlds.
class Worlds
{
public:
  explicit Worlds(const Robot &robot)
    : m_loaded(load(robot)), m_mujoco(mujocoOf(robot)), m_scene(*m_loaded.arm, specOf(m_loaded)), m_checker(m_scene),
      m_oracle(*m_loaded.arm, m_scene), m_larger(*m_loaded.arm, vpCollisionScene(*m_loaded.arm, specOf(m_loaded, 2e-5)))
  {
    const std::vector<vpArmBody> &bodies = m_loaded.arm->spec().bodies;
    const auto nameOf = [&](int capsule) {
      return bodies[static_cast<std::size_t>(m_scene.capsule(capsule).body)].name;
    };
    for (const vpSelfPair &pair : m_scene.selfPairs()) {
      m_checked.insert({nameOf(pair.first), nameOf(pair.second)});
      m_checked.insert({nameOf(pair.second), nameOf(pair.first)});
    }
    for (int i = 0; i < m_scene.capsuleCount(); ++i) {
      for (int j = 0; j < m_scene.objectCount() && m_scene.isChecked(i, j); ++j) {
        m_checked.insert({nameOf(i), m_scene.object(j).name});
        m_checked.insert({m_scene.object(j).name, nameOf(i)});
      }
    }
  }

  //! A random configuration; the obstacles are near a random body.
  void draw(std::mt19937_64 &rng)
  {
    const vpArmModel &arm = *m_loaded.arm;
    m_q = vpTestArms::configuration(arm, rng);
    m_mujoco->place(arm, m_q);
    vpArmData data;
    vpArmKinematics::forward(arm, m_q, data);
    for (int j = 0; j < m_scene.objectCount(); ++j) {
      vpRigidTransform at = pose(rng, 0.4);
      at.p += vpArmKinematics::link(arm, data, std::uniform_int_distribution<int>(1, arm.links())(rng)).p;
      const vpCollisionObject &object = m_scene.object(j);
      m_mujoco->obstacle(object.name, at,
                         j == 0 ? Vector3d(object.shape.radius(), 0., 0.) : Vector3d(0.5 * object.shape.size()));
      REQUIRE(m_scene.moveObject(j, at));
    }
    m_oracle.follow(m_scene);
    m_larger.follow(m_scene);
  }

  void compare()
  {
    const bool ours = m_checker.inCollision(m_q, 0.), byFcl = m_oracle.touches(m_q);
    const std::vector<vpMujoco::Contact> contacts = m_mujoco->contacts();
    const bool byMujoco = std::any_of(contacts.begin(), contacts.end(), [this](const vpMujoco::Contact &c) {
      return c.distance <= 0. && m_checked.count({c.first, c.second}) > 0;
    });
    CAPTURE(m_q.transpose(), ours, byFcl, byMujoco);
    ++poses;
    touching += ours ? 1 : 0;
    ofHulls += byMujoco && !byFcl && !ours ? 1 : 0;
    within += ours && !byFcl ? 1 : 0; // FCL knows surfaces only: MuJoCo's bodies are solid
    missed += !ours && byFcl ? 1 : 0;
    unconfirmed += ours && !byFcl && !byMujoco && !m_larger.touches(m_q) ? 1 : 0; // round shapes are taken larger
    unseen += byFcl && !byMujoco ? 1 : 0;
  }

  int poses = 0, touching = 0, ofHulls = 0, within = 0, missed = 0, unconfirmed = 0, unseen = 0;

private:
  //! \param more : Of the obstacles, m on each side.
  static vpCollisionSceneSpec specOf(const Loaded &loaded, double more = 0.)
  {
    vpCollisionSceneSpec spec;
    spec.objects.resize(2);
    spec.objects[0].name = "ball";
    spec.objects[0].shape = vpCollisionShape::sphere(0.07 + more);
    spec.objects[1].name = "block";
    spec.objects[1].shape = vpCollisionShape::box({0.1 + 2. * more, 0.2 + 2. * more, 0.15 + 2. * more});
    spec.ignoredBodies = loaded.arm->spec().uncovered;
    spec.exact = loaded.exact;
    return spec;
  }

  const Loaded &m_loaded;
  std::unique_ptr<vpMujoco::Arm> m_mujoco;
  vpCollisionScene m_scene;
  vpExactChecker m_checker;
  ExactOracle m_oracle;
  ExactOracle m_larger;                                    // with obstacles as large as they may be taken
  std::set<std::pair<std::string, std::string>> m_checked; // bodies and objects, in both orders
  vpJointVector m_q;
};
} // namespace

TEST_CASE("Contacts of meshes are those that FCL finds, and MuJoCo finds no other that FCL confirms", "[mujoco]")
{
  auto rng = vpTestSupport::generator(971);
  CAPTURE(vpTestSupport::seed());
  for (const Robot &robot : {panda, ur5}) {
    if (fileOf(robot.urdf).empty()) {
      return;
    }
    Worlds worlds(robot);
    for (int problem = 0; problem < vpTestSupport::longer(1000); ++problem) {
      worlds.draw(rng);
      worlds.compare();
    }
    std::cout << robot.name << ": " << worlds.poses << " poses, " << worlds.touching
              << " with a contact; not seen here " << worlds.missed << "; confirmed neither by FCL nor by MuJoCo "
              << worlds.unconfirmed << "; inside of a body, where FCL's surfaces do not touch " << worlds.within
              << "; free poses with contacts of MuJoCo's hulls " << worlds.ofHulls
              << "; contacts of FCL that MuJoCo does not have " << worlds.unseen << '\n';
    CHECK(worlds.missed == 0);
    CHECK(worlds.unconfirmed == 0);
    CHECK(worlds.unseen == 0);
    CHECK(worlds.touching > 0.1 * worlds.poses);
    CHECK(worlds.touching < 0.9 * worlds.poses);
  }
}
