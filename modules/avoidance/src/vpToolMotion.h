/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpToolMotion_h
#define vpToolMotion_h

#include <visp3/avoidance/vpCollisionScene.h>
#include <visp3/manipulator/vpRedundancySolver.h>

BEGIN_VISP_NAMESPACE

//! \brief Parameters of vpToolMotion.
struct vpToolMotionSpec {
  double period = 0.005;        // control period, s
  double repelRange = 0.12;     // m: nearer obstacles repel the adjacent joints
  double postureGain = 0.3;     // towards the goal's configuration, if given
  double limitGain = 0.1;       // away from position limits
  bool keepOrientation = false; // keeps the end effector's orientation, which takes three degrees of freedom
  double orientationGain = 5.;  // 1/s
};

/*!
 * \class vpToolMotion
 * \brief Joint velocities for a velocity of the tool's origin (thesis (8.1), (8.10)-(8.12), corrected): the remaining
 * redundancy moves the arm's body away from obstacles, to the goal's posture and away from limits.
 *
 * No allocation, no exception in step(). Used with a coarse period for prediction and with a fine one for execution.
 */
class vpToolMotion
{
public:
  static constexpr double jointRest = 1e-2; // rad/s: the norm of joint velocities of an arm that stands

  explicit vpToolMotion(const vpArmModel &model, const vpToolMotionSpec &spec = {});

  /*!
   * \param data : After vpCollisionScene::place(); the Jacobian is added. \param near : Pairs of that configuration.
   * \param velocity : Velocity of the tool's origin, base frame, m/s. \param posture : Preferred posture; may be empty.
   * \param orientation : Orientation to keep, if set in the spec. \param previous : Joint velocities of the last
   * period.
   * \param selfMotion : False: no self-motion.
   */
  void step(vpCollisionData &data, const vpNearPairs &near, const Eigen::Vector3d &velocity,
            const vpJointVector &posture, const Eigen::Matrix3d &orientation, const vpJointVector &previous,
            vpRedundancyOutput &output, bool selfMotion = true) noexcept;

  [[nodiscard]] const vpToolMotionSpec &spec() const noexcept { return m_spec; }

private:
  void repel(const vpCollisionData &data, const vpNearPairs &near) noexcept;

  const vpArmModel *m_model;
  vpToolMotionSpec m_spec;
  vpRedundancySolver m_solver;
  vpRedundancyInput m_input;
};

END_VISP_NAMESPACE
#endif
