/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoCommand.h
 * \brief What a servo step answers: a camera twist, a status and a sentence.
 */
#ifndef vpServoCommand_h
#define vpServoCommand_h

#include <visp3/direct_core/vpTwist.h>

BEGIN_VISP_NAMESPACE

//! \ingroup group_feedforward
//! \brief How the servo step went. The motion is safe to execute in every case.
enum class vpServoStatus {
  Servoing,    //!< The law's own twist.
  ViewLimited, //!< The twist was changed to keep the target in the view or within the velocity rows.
  Deadlock,    //!< The view constraint leaves no motion that goes on towards the goal; the twist is near zero.
  Holding,     //!< The target is lost: standing still, in the hope that it comes back.
  Retreating,  //!< The target is lost: going back along the last good motion.
  Lost,   //!< The target is lost and the way back is used up: standing still until it is seen or reset() is called.
  NoGoal, //!< No goal was set yet; zero twist.
  InvalidInput, //!< The measurement is not finite, has a depth <= 0 or not the goal's points; zero twist.
  Degenerate,   //!< The law has no answer here (too few points, singular interaction matrix); zero twist.
  Diverging     //!< The law goes away from the target without end (`ibvs` after a roll of half a turn); zero twist.
};

/*!
 * \ingroup group_feedforward
 * \brief The condition of a loop of steps: true while the camera is on its way or may get there by going on (Servoing,
 * ViewLimited, Holding, Retreating).
 *
 * False ends the loop: message() tells why. The twist is zero then, or near zero (Deadlock). That the goal is reached no
 * status tells, for a law does not know how near is near enough: that is the other half of the condition.
 */
[[nodiscard]] constexpr bool isWorking(vpServoStatus status)
{
  return status == vpServoStatus::Servoing || status == vpServoStatus::ViewLimited ||
         status == vpServoStatus::Holding || status == vpServoStatus::Retreating;
}

//! \ingroup group_feedforward
//! \brief The status as a sentence for a person, static text.
[[nodiscard]] VISP_EXPORT const char *message(vpServoStatus status);
//! \ingroup group_feedforward
//! \brief The status as a word ("Servoing"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *toString(vpServoStatus status);

//! \ingroup group_feedforward
//! \brief Result of one servo step.
struct VISP_EXPORT vpServoCommand {
  vpTwist v;                                    //!< Camera twist in the current camera frame, m/s and rad/s.
  vpServoStatus status = vpServoStatus::NoGoal; //!< How the step went.
};

END_VISP_NAMESPACE
#endif
