/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMujocoArm.h"

#include <mujoco/mujoco.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

namespace vpMujoco
{
namespace
{
std::string readText(const std::string &file)
{
  std::ifstream stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::string withoutComments(std::string xml)
{
  for (std::size_t at = 0; (at = xml.find("<!--", at)) != std::string::npos;) {
    xml.erase(at, xml.find("-->", at) + 3 - at);
  }
  return xml;
}

// Removes the elements <name ...>...</name> and <name .../> for which the condition holds.
void removeElements(std::string &xml, const std::string &name,
                    const std::function<bool(const std::string &)> &condition)
{
  std::size_t at = 0;
  while ((at = xml.find("<" + name, at)) != std::string::npos) {
    const std::size_t head = xml.find('>', at);
    if (xml.find_first_of(" \t\r\n/>", at) != at + 1 + name.size() || head == std::string::npos) {
      at += 1 + name.size(); // another name that begins alike
      continue;
    }
    const std::string tail = "</" + name + ">";
    const std::size_t end = xml[head - 1] == '/' ? head + 1 : xml.find(tail, head) + tail.size();
    if (condition(xml.substr(at, end - at))) {
      xml.erase(at, end - at);
    }
    else {
      at = end;
    }
  }
}

void removeAll(std::string &xml, const std::string &name)
{
  removeElements(xml, name, [](const std::string &) { return true; });
}

std::string attribute(const std::string &element, const std::string &name)
{
  std::smatch match;
  const std::regex pattern("\\s" + name + "\\s*=\\s*[\"']([^\"']*)[\"']");
  return std::regex_search(element, match, pattern) ? match[1].str() : "";
}

// Exchanges file names of meshes for short ones, whose content goes into the virtual file system.
void packMeshes(std::string &xml, const Options &options, mjVFS &files)
{
  std::map<std::string, std::string> known;
  std::size_t at = 0;
  while ((at = xml.find("<mesh", at)) != std::string::npos) {
    const std::size_t end = xml.find('>', at);
    const std::string element = xml.substr(at, end - at), name = attribute(element, "filename");
    auto found = known.find(name);
    if (found == known.end()) {
      found = known.emplace(name, "m" + std::to_string(known.size()) + ".stl").first;
      const std::string content = options.mesh(name);
      const int size = static_cast<int>(content.size());
      if (mj_makeEmptyFileVFS(&files, found->second.c_str(), size) != 0) {
        throw std::runtime_error("MuJoCo takes no mesh " + name);
      }
      std::memcpy(files.filedata[mj_findFileVFS(&files, found->second.c_str())], content.data(), content.size());
    }
    xml.replace(xml.find(name, at), name.size(), found->second);
    at += 5;
  }
}

// MuJoCo's own element: fixed links stay bodies, inertias come from the file alone. Bodies without mass, which it
// refuses, get one that is negligible.
constexpr const char *compilerElement =
    "<mujoco><compiler strippath=\"false\" discardvisual=\"false\" fusestatic=\"false\" inertiafromgeom=\"false\" "
    "balanceinertia=\"true\" boundmass=\"1e-12\" boundinertia=\"1e-14\"/></mujoco>";

std::string obstacleElements(const std::string &root)
{
  std::string text;
  for (const auto &[name, shape] :
       {std::pair("ball", "<sphere radius=\"1\"/>"), std::pair("block", "<box size=\"1 1 1\"/>")}) {
    text += std::string("<link name=\"") + name + "\"><collision><geometry>" + shape +
            "</geometry></collision></link><joint name=\"of " + name + "\" type=\"fixed\"><parent link=\"" + root +
            "\"/><child link=\"" + name + "\"/></joint>";
  }
  return text;
}

// The link that is no child.
std::string rootOf(const std::string &xml)
{
  std::set<std::string> children;
  const std::regex child("<child\\s[^>]*>"), link("<link\\s[^>]*>");
  for (std::sregex_iterator i(xml.begin(), xml.end(), child), end; i != end; ++i) {
    children.insert(attribute(i->str(), "link"));
  }
  for (std::sregex_iterator i(xml.begin(), xml.end(), link), end; i != end; ++i) {
    if (children.count(attribute(i->str(), "name")) == 0) {
      return attribute(i->str(), "name");
    }
  }
  return "";
}

// True for an inertia that no body has, which MuJoCo then changes.
bool isImpossible(const std::string &link)
{
  const std::size_t at = link.find("<inertia ");
  if (at == std::string::npos) {
    return false;
  }
  const std::string inertia = link.substr(at, link.find('>', at) - at);
  const auto number = [&inertia](const char *name) { return std::atof(attribute(inertia, name).c_str()); };
  Eigen::Matrix3d I;
  I << number("ixx"), number("ixy"), number("ixz"), number("ixy"), number("iyy"), number("iyz"), number("ixz"),
      number("iyz"), number("izz");
  const Eigen::Vector3d moments = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(I).eigenvalues();
  return !(moments(0) + moments(1) >= moments(2));
}

vpRigidTransform transform(const mjtNum *position, const mjtNum *matrix)
{
  vpRigidTransform T;
  T.R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(matrix);
  T.p = Eigen::Map<const Eigen::Vector3d>(position);
  return T;
}
} // namespace

Arm::Arm(const std::string &urdf, const Options &options)
  : m_model(nullptr, mj_deleteModel), m_data(nullptr, mj_deleteData)
{
  mju_user_warning = [](const char *) {}; // else it writes a file
  std::string xml = withoutComments(readText(urdf));
  for (const char *name : {"visual", "gazebo", "transmission", "self_collision_checking", "sensor"}) {
    removeAll(xml, name);
  }
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  if (options.mesh) {
    packMeshes(xml, options, *files);
  }
  removeElements(xml, "collision", [&options](const std::string &element) {
    return options.mesh ? false : !options.obstacles || element.find("<mesh") != std::string::npos;
  });
  removeElements(xml, "joint", [this](const std::string &element) {
    const std::size_t at = element.find("<mimic");
    if (at != std::string::npos) {
      const std::string mimic = element.substr(at, element.find('>', at) - at);
      const std::string ratio = attribute(mimic, "multiplier"), offset = attribute(mimic, "offset");
      m_mimics[attribute(element, "name")] = {attribute(mimic, "joint"), ratio.empty() ? 1. : std::atof(ratio.c_str()),
                                              std::atof(offset.c_str())};
    }
    return false;
  });
  removeElements(xml, "link", [this](const std::string &element) {
    if (isImpossible(element)) {
      m_impossible.push_back(attribute(element, "name"));
    }
    return false;
  });
  if (options.obstacles) {
    xml.insert(xml.rfind("</robot>"), obstacleElements(rootOf(xml)));
  }
  xml.insert(xml.find('>', xml.find("<robot")) + 1, compilerElement);
  mj_makeEmptyFileVFS(files.get(), "robot.urdf", static_cast<int>(xml.size()));
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), "robot.urdf")], xml.data(), xml.size());
  char error[500] = "";
  m_model.reset(mj_loadXML("robot.urdf", files.get(), error, sizeof(error)));
  mj_deleteVFS(files.get());
  if (!m_model) {
    throw std::runtime_error(error);
  }
  m_data.reset(mj_makeData(m_model.get()));
  mj_kinematics(m_model.get(), m_data.get());
}

Arm::~Arm() = default;

int Arm::joint(const std::string &name) const { return mj_name2id(m_model.get(), mjOBJ_JOINT, name.c_str()); }

Arm::Mimic Arm::leader(const std::string &name) const
{
  Mimic all{name, 1., 0.};
  for (auto next = m_mimics.find(name); next != m_mimics.end(); next = m_mimics.find(all.of)) {
    all = {next->second.of, all.ratio * next->second.ratio, all.offset + all.ratio * next->second.offset};
  }
  return all;
}

int Arm::body(const std::string &name) const
{
  const int id = mj_name2id(m_model.get(), mjOBJ_BODY, name.c_str());
  if (id < 0) {
    throw std::runtime_error("MuJoCo has no body " + name);
  }
  return id;
}

bool Arm::hasBody(const std::string &name) const { return mj_name2id(m_model.get(), mjOBJ_BODY, name.c_str()) >= 0; }

std::vector<std::string> Arm::leaves() const
{
  std::vector<std::string> names;
  for (int i = 1; i < m_model->nbody; ++i) {
    if (std::find(m_model->body_parentid + 1, m_model->body_parentid + m_model->nbody, i) ==
        m_model->body_parentid + m_model->nbody) {
      names.emplace_back(m_model->names + m_model->name_bodyadr[i]);
    }
  }
  return names;
}

void Arm::place(const vpArmModel &model, const vpJointVector &q)
{
  for (mjtNum *numbers : {m_data->qvel, m_data->qfrc_applied, m_data->qacc_warmstart}) {
    std::fill_n(numbers, m_model->nv, 0.);
  }
  for (int id = 0; id < m_model->njnt; ++id) {
    const double *range = m_model->jnt_range + 2 * id;
    m_data->qpos[m_model->jnt_qposadr[id]] =
        m_model->jnt_limited[id] != 0U ? std::min(std::max(0., range[0]), range[1]) : 0.;
  }
  for (int i = 0; i < model.size(); ++i) {
    const int id = joint(model.spec().joints[static_cast<std::size_t>(i)].name);
    if (id < 0) {
      throw std::runtime_error("MuJoCo has no joint " + model.spec().joints[static_cast<std::size_t>(i)].name);
    }
    m_data->qpos[m_model->jnt_qposadr[id]] = q(i);
  }
  const auto isAmong = [](const auto &list, const std::string &name) {
    return std::any_of(list.begin(), list.end(), [&name](const auto &one) { return one.name == name; });
  };
  std::map<std::string, double> decided; // by the joints of the arm: of what they mimic, in the end
  for (int i = 0; i < model.size(); ++i) {
    const Mimic own = leader(model.spec().joints[static_cast<std::size_t>(i)].name);
    decided[own.of] = (q(i) - own.offset) / own.ratio;
  }
  for (const auto &item : m_mimics) {
    const std::string &follower = item.first;
    const Mimic mimic = leader(follower);
    const int id = joint(follower), of = joint(mimic.of);
    if (id >= 0 && of >= 0 && !isAmong(model.spec().joints, follower)) {
      const bool isOfChain = isAmong(model.spec().followers, follower);
      const double at = isOfChain ? decided.at(mimic.of) : m_data->qpos[m_model->jnt_qposadr[of]];
      m_data->qpos[m_model->jnt_qposadr[id]] = mimic.ratio * at + mimic.offset;
    }
  }
  mj_kinematics(m_model.get(), m_data.get());
  mj_comPos(m_model.get(), m_data.get());
}

vpRigidTransform Arm::pose(const std::string &name) const
{
  const int id = body(name);
  return transform(m_data->xpos + 3 * id, m_data->xmat + 9 * id);
}

std::string Arm::carrier(const std::string &name, const std::vector<std::string> &names) const
{
  for (int id = body(name); id > 0; id = m_model->body_parentid[id]) {
    const std::string here = m_model->names + m_model->name_bodyadr[id];
    if (std::find(names.begin(), names.end(), here) != names.end()) {
      return here;
    }
  }
  return "";
}

void Arm::keepMassesOf(const vpArmModel &model)
{
  std::set<int> kept;
  for (const vpArmJointSpec &spec : model.spec().joints) {
    kept.insert(joint(spec.name));
  }
  for (const vpArmFollower &spec : model.spec().followers) {
    kept.insert(joint(spec.name));
  }
  std::vector<bool> beside(static_cast<std::size_t>(m_model->nbody), false);
  for (int i = 1; i < m_model->nbody; ++i) {
    const bool own = m_model->body_jntnum[i] > 0 && kept.count(m_model->body_jntadr[i]) == 0;
    beside[static_cast<std::size_t>(i)] = own || beside[static_cast<std::size_t>(m_model->body_parentid[i])];
    const auto &bodies = model.spec().bodies;
    const std::string name = m_model->names + m_model->name_bodyadr[i];
    const bool listed = std::any_of(bodies.begin(), bodies.end(), [&](const vpArmBody &b) { return b.name == name; });
    if (beside[static_cast<std::size_t>(i)] && !listed) {
      m_model->body_mass[i] = 0.;
      std::fill_n(m_model->body_inertia + 3 * i, 3, 0.);
    }
  }
}

bool Arm::hasFollowerBeside(const vpArmModel &model) const
{
  std::set<std::string> chain;
  for (const vpArmJointSpec &own : model.spec().joints) {
    chain.insert(own.name);
  }
  for (const vpArmFollower &own : model.spec().followers) {
    chain.insert(own.name);
  }
  return std::any_of(m_mimics.begin(), m_mimics.end(), [&chain](const auto &mimic) {
    return chain.count(mimic.second.of) > 0 && chain.count(mimic.first) == 0;
  });
}

bool Arm::changesMassesOf(const vpArmModel &model) const
{
  return std::any_of(m_impossible.begin(), m_impossible.end(), [&](const std::string &name) {
    int id = hasBody(name) ? body(name) : 0;
    while (id > 0 && m_model->body_jntnum[id] == 0) {
      id = m_model->body_parentid[id];
    }
    const auto &joints = model.spec().joints;
    return std::any_of(joints.begin(), joints.end(),
                       [&](const vpArmJointSpec &j) { return id > 0 && joint(j.name) == m_model->body_jntadr[id]; });
  });
}

std::vector<int> Arm::dofs(const vpArmModel &model) const
{
  std::vector<int> list;
  for (const vpArmJointSpec &spec : model.spec().joints) {
    list.push_back(m_model->jnt_dofadr[joint(spec.name)]);
  }
  return list;
}

Eigen::MatrixXd Arm::ratios(const vpArmModel &model) const
{
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(m_model->nv, model.size());
  const std::vector<int> own = dofs(model);
  for (int i = 0; i < model.size(); ++i) {
    C(own[static_cast<std::size_t>(i)], i) = 1.;
  }
  for (const vpArmFollower &follower : model.spec().followers) { // both may mimic one beside the chain
    C(m_model->jnt_dofadr[joint(follower.name)], follower.joint) =
        leader(follower.name).ratio / leader(model.spec().joints[static_cast<std::size_t>(follower.joint)].name).ratio;
  }
  return C;
}

void Arm::dynamics(const vpArmModel &model, const vpJointVector &velocity, vpJointMatrix &M, vpJointVector &bias)
{
  const Eigen::MatrixXd C = ratios(model);
  const int all = m_model->nv;
  Eigen::VectorXd torque(all);
  Eigen::Map<Eigen::VectorXd>(m_data->qvel, all) = C * velocity;
  mj_crb(m_model.get(), m_data.get());
  Eigen::MatrixXd full(all, all); // symmetric
  mj_fullM(m_model.get(), full.data(), m_data->qM);
  mj_comVel(m_model.get(), m_data.get());
  mj_rne(m_model.get(), m_data.get(), 0, torque.data());
  M = C.transpose() * full * C;
  bias = C.transpose() * torque;
}

std::pair<double, double> Arm::friction(const std::string &name) const
{
  const int dof = m_model->jnt_dofadr[joint(name)];
  return {m_model->dof_damping[dof], m_model->dof_frictionloss[dof]};
}

void Arm::step(const vpArmModel &model, const vpJointVector &torque, double dt)
{
  m_model->opt.timestep = dt;
  m_model->opt.disableflags |= mjDSBL_CONTACT | mjDSBL_LIMIT;
  const std::vector<int> at = dofs(model);
  for (int i = 0; i < model.size(); ++i) {
    m_data->qfrc_applied[at[static_cast<std::size_t>(i)]] = torque(i);
  }
  mj_step(m_model.get(), m_data.get());
}

vpJointVector Arm::configuration(const vpArmModel &model) const
{
  vpJointVector q(model.size());
  for (int i = 0; i < model.size(); ++i) {
    q(i) = m_data->qpos[m_model->jnt_qposadr[joint(model.spec().joints[static_cast<std::size_t>(i)].name)]];
  }
  return q;
}

void Arm::obstacle(const std::string &name, const vpRigidTransform &pose, const Eigen::Vector3d &size)
{
  const int id = body(name), geom = m_model->body_geomadr[id];
  const Eigen::Quaterniond turn(pose.R);
  const double quaternion[4] = {turn.w(), turn.x(), turn.y(), turn.z()};
  std::copy_n(pose.p.data(), 3, m_model->body_pos + 3 * id);
  std::copy_n(quaternion, 4, m_model->body_quat + 4 * id);
  std::copy_n(size.data(), 3, m_model->geom_size + 3 * geom);
  m_model->geom_rbound[geom] = m_model->geom_type[geom] == mjGEOM_SPHERE ? size(0) : size.norm();
}

std::vector<Contact> Arm::contacts()
{
  mj_kinematics(m_model.get(), m_data.get()); // obstacles have moved
  mj_comPos(m_model.get(), m_data.get());
  mj_collision(m_model.get(), m_data.get());
  const auto nameOf = [this](int geom) {
    return std::string(m_model->names + m_model->name_bodyadr[m_model->geom_bodyid[geom]]);
  };
  std::vector<Contact> list;
  for (int i = 0; i < m_data->ncon; ++i) {
    const mjContact &contact = m_data->contact[i];
    list.push_back({nameOf(contact.geom1), nameOf(contact.geom2), contact.dist});
  }
  return list;
}
} // namespace vpMujoco
