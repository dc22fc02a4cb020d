/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoCommand.h
 * \brief Output of a servo step: a camera twist, a status and a message.
 */
#ifndef vpServoCommand_h
#define vpServoCommand_h

#include <visp3/direct_core/vpTwist.h>

BEGIN_VISP_NAMESPACE

//! \ingroup group_feedforward
//! \brief Result of the servo step. The motion is safe to execute in every case.
enum class vpServoStatus {
  Servoing,    //!< The law's own twist.
  ViewLimited, //!< The twist was changed to keep the target in view or the velocities within their limits.
  Deadlock,    //!< The view constraint leaves no motion towards the goal; the twist is near zero.
  Holding,     //!< The target is lost: standing still and waiting for it to reappear.
  Retreating,  //!< The target is lost: undoing the last motion.
  Lost,   //!< The target is lost and the retreat is finished: standing still until it is seen or reset() is called.
  NoGoal, //!< No goal is set; zero twist.
  InvalidInput, //!< The measurement is not finite, has a depth <= 0 or not the goal's points; zero twist.
  Degenerate, //!< The law has no solution here (too few points, singular interaction matrix, no plan within the limits).
  Diverging   //!< The camera moves away without bound (`ibvs` after a roll of half a turn); zero twist.
};

/*!
 * \ingroup group_feedforward
 * \brief Loop condition: true while the camera moves to the goal or may recover (Servoing, ViewLimited, Holding,
 * Retreating).
 *
 * False ends the loop: vpMessage() gives the reason. The twist is zero then, near zero (Deadlock), or
 * brakes within the limits (laws that plan). No status reports
 * that the goal is reached, because the required accuracy is the caller's choice and part of the caller's condition.
 */
[[nodiscard]] constexpr bool vpIsWorking(vpServoStatus status)
{
  return status == vpServoStatus::Servoing || status == vpServoStatus::ViewLimited ||
         status == vpServoStatus::Holding || status == vpServoStatus::Retreating;
}

//! \ingroup group_feedforward
//! \brief Status as a sentence for users, static text.
[[nodiscard]] VISP_EXPORT const char *vpMessage(vpServoStatus status);
//! \ingroup group_feedforward
//! \brief Status as a word ("Servoing"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpServoStatus status);

//! \ingroup group_feedforward
//! \brief Result of one servo step.
struct VISP_EXPORT vpServoCommand {
  vpTwist v;                                    //!< Camera twist in the current camera frame, m/s and rad/s.
  vpServoStatus status = vpServoStatus::NoGoal; //!< Result of the step.
};

END_VISP_NAMESPACE
#endif
