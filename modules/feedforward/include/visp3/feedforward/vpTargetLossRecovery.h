/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTargetLossRecovery.h
 * \brief What to do when the target is lost: wait, then go back the way the camera came.
 */
#ifndef vpTargetLossRecovery_h
#define vpTargetLossRecovery_h

#include <visp3/feedforward/vpServoCommand.h>

#include <cstddef>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_feedforward
//! \brief Parameters of vpTargetLossRecovery.
struct VISP_EXPORT vpTargetLossConfig {
  double holdTime = 0.5;   //!< Time to stand still first, s, >= 0.
  double retreatTime = 2.; //!< How much of the last motion is undone at most, s of recorded motion, >= 0 (0: none).
  double maxLinear = 0.2;  //!< Limit of the linear speed on the way back, m/s, > 0.
  double maxAngular = 0.5; //!< Limit of the angular speed on the way back, rad/s, > 0.
  unsigned int capacity = 1000; //!< Number of cycles remembered, 1..100000. Older ones are forgotten.

  //! \throw vpException (badValue) naming the field and its value when one is out of its range or not finite.
  void validate() const;
};

/*!
 * \class vpTargetLossRecovery
 * \ingroup group_feedforward
 * \brief Holds, then retreats along the last good motion, then gives up; resumes the moment the target is seen again.
 *
 * While the target is seen, each moving twist is remembered with its duration. When it is lost, the camera stands still
 * for the hold time and then undoes the remembered motion, last one first: the opposite twist for the same time brings
 * a camera back to where it was, exactly. Where the recorded speed exceeds the limits of the retreat, twist and time
 * are stretched by the same factor, so the path stays the same. What has been undone is forgotten.
 */
class VISP_EXPORT vpTargetLossRecovery
{
public:
  //! \throw vpException (badValue) naming the field and its value.
  explicit vpTargetLossRecovery(const vpTargetLossConfig &config = {});

  //! The parameters in force.
  [[nodiscard]] const vpTargetLossConfig &config() const { return m_config; }
  //! Forget the motion and the loss.
  void reset() noexcept;

  /*!
   * One cycle. Allocates nothing.
   * \param command : Answer of the law and its filter. Holding means that the target is not seen; every other status
   *   passes through.
   * \param dt : Time for which the twist will be executed, s, > 0; InvalidInput with zero twist otherwise,
   *   and when the command is not finite.
   * \return The command itself; or, while the target is lost, Holding (zero twist), Retreating, and Lost (zero twist).
   */
  [[nodiscard]] vpServoCommand update(const vpServoCommand &command, double dt) noexcept;

private:
  struct Sample {
    vpTwist v;
    double duration = 0.; // s
  };

  void remember(const vpTwist &v, double duration) noexcept;
  vpServoCommand retreat(double dt) noexcept;

  vpTargetLossConfig m_config;
  std::vector<Sample> m_samples; // ring of fixed size
  std::size_t m_next = 0;        // where the next sample goes
  std::size_t m_count = 0;
  double m_lostFor = 0.; // s
  double m_undone = 0.;  // recorded motion undone since the loss, s
};

END_VISP_NAMESPACE
#endif
