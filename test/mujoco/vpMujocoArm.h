/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A URDF as MuJoCo reads it: an independent oracle for kinematics, dynamics and contacts of arms.
#ifndef vpMujocoArm_h
#define vpMujocoArm_h

#include <visp3/manipulator/vpArmModel.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

struct mjModel_;
struct mjData_;

VISP_DIRECT_USING_NAMESPACE

namespace vpMujoco
{
//! What MuJoCo makes of a URDF.
struct Options {
  bool obstacles = false; //!< Keeps collision geometry, and adds a "ball" and a "block", see Arm::obstacle().
  //! Content of a binary STL file for a mesh of the URDF; empty: geometry with a mesh is left out.
  std::function<std::string(const std::string &)> mesh;
};

//! Two touching bodies, by their names in the URDF.
struct Contact {
  std::string first, second;
  double distance = 0.; //!< m, negative: penetration.
};

class Arm
{
public:
  //! \throw std::runtime_error with MuJoCo's sentence if it refuses the file.
  explicit Arm(const std::string &urdf, const Options &options = {});
  ~Arm();
  Arm(const Arm &) = delete;
  Arm &operator=(const Arm &) = delete;

  //! Bodies without children: ends of chains.
  [[nodiscard]] std::vector<std::string> leaves() const;
  [[nodiscard]] bool hasBody(const std::string &name) const;
  //! Places the joints of a model by their names, at rest. Those beside the chain follow the one that they mimic, or
  //! are at 0 or the limit next to it.
  void place(const vpArmModel &model, const vpJointVector &q);
  //! Frame of a body in the root link, after place(); before, with all joints at 0.
  [[nodiscard]] vpRigidTransform pose(const std::string &body) const;
  //! Nearest body at or above \e body that is in \e names; empty if there is none.
  [[nodiscard]] std::string carrier(const std::string &body, const std::vector<std::string> &names) const;

  //! Sets the masses of all bodies to zero that a joint beside the chain moves and that the model does not list.
  void keepMassesOf(const vpArmModel &model);
  //! True if MuJoCo changes an inertia that the joints of a model move, since no body has it.
  [[nodiscard]] bool changesMassesOf(const vpArmModel &model) const;
  //! True if a joint beside the chain mimics one of it: its mass moves, where a vpArmModel takes it as fixed.
  [[nodiscard]] bool hasFollowerBeside(const vpArmModel &model) const;
  //! Inertia matrix of the joints of a model, and C q' + g, after place().
  void dynamics(const vpArmModel &model, const vpJointVector &velocity, vpJointMatrix &M, vpJointVector &bias);
  //! Damping and friction of a joint.
  [[nodiscard]] std::pair<double, double> friction(const std::string &joint) const;
  //! One step of MuJoCo's integrator from its own state, without contacts and limits.
  void step(const vpArmModel &model, const vpJointVector &torque, double dt);
  [[nodiscard]] vpJointVector configuration(const vpArmModel &model) const;

  //! Moves and resizes an obstacle; a ball takes its radius from size(0), a block has half edges.
  void obstacle(const std::string &name, const vpRigidTransform &pose, const Eigen::Vector3d &size);
  //! Touching bodies. MuJoCo takes a mesh as its hull: contacts of meshes may be false, none is missing.
  [[nodiscard]] std::vector<Contact> contacts();

private:
  [[nodiscard]] int joint(const std::string &name) const;
  [[nodiscard]] int body(const std::string &name) const;
  [[nodiscard]] std::vector<int> dofs(const vpArmModel &model) const;

  struct Mimic {
    std::string of;
    double ratio = 1., offset = 0.;
  };
  //! The joint that a joint mimics in the end, or itself.
  [[nodiscard]] Mimic leader(const std::string &joint) const;
  //! Velocities of all joints of MuJoCo's per velocity of each joint of a model: itself and its followers.
  [[nodiscard]] Eigen::MatrixXd ratios(const vpArmModel &model) const;
  std::map<std::string, Mimic> m_mimics; // by follower
  std::vector<std::string> m_impossible; // links whose inertia no body has
  std::unique_ptr<mjModel_, void (*)(mjModel_ *)> m_model;
  std::unique_ptr<mjData_, void (*)(mjData_ *)> m_data;
};
} // namespace vpMujoco

#endif
