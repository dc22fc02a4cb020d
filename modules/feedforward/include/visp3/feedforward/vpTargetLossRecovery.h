/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTargetLossRecovery.h
 * \brief Recovery of a lost target: wait, then retrace the last motion.
 */
#ifndef vpTargetLossRecovery_h
#define vpTargetLossRecovery_h

#include <visp3/feedforward/vpServoCommand.h>

#include <cstddef>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_feedforward
//! \brief Parameters of vpTargetLossRecovery.
struct VISP_EXPORT vpTargetLossSpec {
  double holdTime = 0.5;        //!< Time to stand still before the retreat, s, >= 0.
  double retreatTime = 2.;      //!< Maximum of recorded motion to undo, s, >= 0 (0: no retreat).
  double maxLinear = 0.2;       //!< Limit of the linear speed of the retreat, m/s, > 0.
  double maxAngular = 0.5;      //!< Limit of the angular speed of the retreat, rad/s, > 0.
  unsigned int capacity = 1000; //!< Number of recorded cycles, 1..100000. Older ones are dropped.

  //! \throw vpException (badValue) naming the field and its value when one is out of its range or not finite.
  void validate() const;
};

/*!
 * \class vpTargetLossRecovery
 * \ingroup group_feedforward
 * \brief Holds, then retreats along the last good motion, then gives up; resumes as soon as the target is seen again.
 *
 * While the target is seen, each nonzero twist is recorded with its duration. When it is lost, the camera stands still
 * for the hold time and then undoes the recorded motion, most recent first: the opposite twist for the same time
 * returns a camera exactly to its previous pose. Where the recorded speed exceeds the limits of the retreat, twist and
 * time are scaled by the same factor, so the path stays the same. Undone motion is removed from the record.
 *
 * \code
 * vpTargetLossRecovery recovery({0.3, 2., 0.1, 0.3}); // hold for 0.3 s, then undo 2 s, at 0.1 m/s and 0.3 rad/s
 * vpServoCommand command;
 * do {
 *   command = recovery.step(law.step(measurement, dt), dt); // measurement.valid = false where it is not seen
 *   robot.setVelocity(vpRobot::CAMERA_FRAME, command.v.toColVector());
 * } while (vpIsWorking(command.status) && !closeEnough(measurement));
 * if (!vpIsWorking(command.status)) {
 *   std::cerr << vpMessage(command.status) << std::endl; // lost for good, say
 * }
 * \endcode
 */
class VISP_EXPORT vpTargetLossRecovery
{
public:
  //! \throw vpException (badValue) naming the field and its value.
  explicit vpTargetLossRecovery(const vpTargetLossSpec &spec = {});

  //! Current parameters.
  [[nodiscard]] const vpTargetLossSpec &spec() const { return m_spec; }
  //! Forget the recorded motion and the loss.
  void reset() noexcept;

  /*!
   * One cycle. Allocates nothing.
   * \param command : Result of the law and its filter. Holding means that the target is not seen; every other status
   *   passes through.
   * \param dt : Time for which the twist will be executed, s, > 0; InvalidInput with zero twist otherwise,
   *   and when the command is not finite.
   * \return The command itself; or, while the target is lost, Holding (zero twist), Retreating, and Lost (zero twist).
   */
  [[nodiscard]] vpServoCommand step(const vpServoCommand &command, double dt) noexcept;

private:
  struct Sample {
    vpTwist v;
    double duration = 0.; // s
  };

  void remember(const vpTwist &v, double duration) noexcept;
  vpServoCommand retreat(double dt) noexcept;

  vpTargetLossSpec m_spec;
  std::vector<Sample> m_samples; // ring of fixed size
  std::size_t m_next = 0;        // index of the next sample
  std::size_t m_count = 0;
  double m_lostFor = 0.; // s
  double m_undone = 0.;  // recorded motion undone since the loss, s
};

END_VISP_NAMESPACE
#endif
