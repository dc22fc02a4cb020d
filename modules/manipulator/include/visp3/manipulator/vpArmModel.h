/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmModel.h
 * \brief Validated, immutable model of an arm.
 */
#ifndef vpArmModel_h
#define vpArmModel_h

#include <visp3/manipulator/vpArmSpec.h>

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <typeindex>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_manipulator
 * \brief Joint or follower of an arm, in the order of the chain.
 */
struct VISP_EXPORT vpArmChainJoint {
  vpRigidTransform step;    //!< Frame at the coordinate 0 in the moving frame of the one before, or of the base.
  vpRigidTransform after;   //!< Frame of the link that it moves, in its moving frame.
  bool isPrismatic = false; //!< Moves along z; else it rotates about z.
  int joint = 0;            //!< Joint that decides: this one, or the one that it follows.
  double ratio = 1.;        //!< Its coordinate is ratio * q(joint) + offset, rad or m.
  double offset = 0.;       //!< See ratio.
};

/*!
 * \class vpArmModel
 * \ingroup group_manipulator
 * \brief Immutable serial arm of 1 to vpArmMaxJoints joints; results of a control cycle are kept in vpArmData.
 *
 * It has n joints, which are commanded, and l >= n links: joints may have followers (vpArmSpec::followers). All vectors
 * of configurations, velocities, limits and torques have n numbers.
 *
 * Created from a vpArmSpec, by vpLoadArmJson() or by vpLoadArmUrdf(). Copy it during set-up, not in a control loop.
 *
 * \code
 * const vpArmModel amor = vpLoadArmJson("data/robot/amor.json");
 * amor.requireMotionLimits("my program"); // throws, naming the joint
 * const vpJointVector there = amor.home() + vpJointVector::Constant(amor.size(), 0.3); // rad
 * const std::string fault = amor.outsideLimits(there);
 * std::cout << (fault.empty() ? "within the limits" : fault) << std::endl;
 * \endcode
 */
class VISP_EXPORT vpArmModel
{
public:
  /*!
   * \throw vpException (badValue) naming the arm or its file, the joint, link or body, and the value: no joint or more
   * than vpArmMaxJoints, empty or duplicate names, limits that are not lower < upper, velocity, acceleration or torque
   * limits not > 0, masses not > 0, physically impossible inertias, invalid rotations, bodies, shapes and capsules of a
   * link or body that does not exist or with a size that is not > 0 (of a mesh: 0), a mesh without a file, pairs of
   * bodies that do not exist; followers of no joint, with a ratio out of range, or that would move without limits along
   * z; an end effector or a camera on no link; positions, links, shapes and capsules beyond 10 km, other numbers beyond
   * vpArmLargest.
   */
  explicit vpArmModel(const vpArmSpec &spec);

  //! Number of joints n.
  [[nodiscard]] int size() const noexcept { return m_size; }
  //! Number of links l, without the base: of joints and followers.
  [[nodiscard]] int links() const noexcept { return m_links; }
  //! The specification of the arm.
  [[nodiscard]] const vpArmSpec &spec() const noexcept { return m_spec; }
  //! The source file, or the name if there is none.
  [[nodiscard]] const std::string &label() const noexcept
  {
    return m_spec.source.empty() ? m_spec.name : m_spec.source;
  }
  //! True if joint \e i (0..n-1) is prismatic.
  [[nodiscard]] bool isPrismatic(int i) const noexcept { return m_prismatic[static_cast<std::size_t>(i)]; }
  //! True if joint \e i (0..n-1) is continuous: rotates without limits.
  [[nodiscard]] bool isContinuous(int i) const noexcept { return m_continuous[static_cast<std::size_t>(i)]; }
  //! Lower position limits, rad or m; -infinity for a continuous joint.
  [[nodiscard]] const vpJointVector &lower() const noexcept { return m_lower; }
  //! Upper position limits, rad or m; infinity for a continuous joint.
  [[nodiscard]] const vpJointVector &upper() const noexcept { return m_upper; }
  //! Velocity limits, rad/s or m/s; may be infinite.
  [[nodiscard]] const vpJointVector &velocity() const noexcept { return m_velocity; }
  //! Acceleration limits, rad/s^2 or m/s^2; may be infinite.
  [[nodiscard]] const vpJointVector &acceleration() const noexcept { return m_acceleration; }
  //! Torque or force limits, Nm or N; may be infinite.
  [[nodiscard]] const vpJointVector &torque() const noexcept { return m_torque; }
  //! Home configuration, rad or m: that of the spec, else mid-range of each joint (0 for a continuous joint).
  [[nodiscard]] const vpJointVector &home() const noexcept { return m_home; }
  //! True if every link has a mass.
  [[nodiscard]] bool hasMasses() const noexcept { return m_hasMasses; }
  /*!
   * Checks a configuration against the position limits, with the tolerance common to all limits (vpLimit).
   * \param q : Configuration, n numbers, rad or m.
   * \return Empty if within the limits; else the violation, with enough digits to distinguish value and limit: "joint
   * elbow at 3.2, outside its limits -3.1 and 3.1". NaN is never within.
   */
  [[nodiscard]] std::string outsideLimits(const vpJointVector &q) const;
  /*!
   * Requires velocity and acceleration limits of all joints.
   * \param user : Name of the caller, for the message ("the redundancy solver").
   * \throw vpException (badValue) naming the first joint whose velocity or acceleration limit is infinite.
   */
  void requireMotionLimits(const char *user) const;

  //! Joint or follower \e k (0..l-1) in the order of the chain; it moves link k + 1.
  [[nodiscard]] const vpArmChainJoint &chain(int k) const noexcept { return m_chain[static_cast<std::size_t>(k)]; }
  //! Coordinates of all of the chain, followers included: l numbers, rad or m. \param q : n numbers.
  [[nodiscard]] vpJointVector coordinates(const vpJointVector &q) const noexcept;
  //! The same change or velocity for all of the chain: l numbers. \param change : n numbers, rad or m, or their rates.
  [[nodiscard]] vpJointVector changes(const vpJointVector &change) const noexcept;
  //! Links that move the end effector: the number of the one that carries it, 1..l.
  [[nodiscard]] int toolLink() const noexcept { return m_spec.toolLink < 0 ? m_links : m_spec.toolLink; }
  //! Links that move the camera: the number of the one that carries it, 1..l.
  [[nodiscard]] int cameraLink() const noexcept { return m_spec.cameraLink < 0 ? toolLink() : m_spec.cameraLink; }
  //! Frame of the end effector in the moving frame of the joint that moves its link.
  [[nodiscard]] const vpRigidTransform &toolStep() const noexcept { return m_toolStep; }

  /*!
   * What follows from the arm alone and takes long to find: made as T(arm) by the first caller, then shared by all
   * copies of the arm, in all threads. For set-up. T must not keep a copy of the arm.
   */
  template <class T> [[nodiscard]] std::shared_ptr<const T> derived() const
  {
    const std::lock_guard<std::mutex> lock(m_derived->mutex);
    std::shared_ptr<const void> &value = m_derived->values[typeid(T)];
    if (!value) {
      value = std::make_shared<const T>(*this);
    }
    return std::static_pointer_cast<const T>(value);
  }

private:
  struct Derived {
    std::mutex mutex;
    std::map<std::type_index, std::shared_ptr<const void>> values;
  };

  void makeChain();

  vpArmSpec m_spec;
  int m_size = 0, m_links = 0;
  bool m_hasMasses = false;
  std::array<bool, vpArmMaxJoints> m_prismatic{};
  std::array<bool, vpArmMaxJoints> m_continuous{};
  std::array<vpArmChainJoint, vpArmMaxJoints> m_chain;
  vpRigidTransform m_toolStep;
  std::shared_ptr<Derived> m_derived = std::make_shared<Derived>();
  vpJointVector m_lower, m_upper, m_velocity, m_acceleration, m_torque, m_home;
};

END_VISP_NAMESPACE
#endif
