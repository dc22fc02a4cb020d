/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file servoRows.h
 * \brief Quantities read from servo runs, and the rows of figures 5.6 to 5.11 on an arm and with noise on both views.
 */
#ifndef thesisReport_servoRows_h
#define thesisReport_servoRows_h

#include "part.h"

#include "lab/servo/vpServoExperiment.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace thesisReport
{
VISP_DIRECT_USING_NAMESPACE

//! The law of the thesis, and the compared laws as meant by the thesis.
constexpr const char *FEEDFORWARD = "ff-sum", *PBVS = "pbvs1", *KYRKI = "kyrki-decoupled";

// Quantities read from the curves. Angles in deg.
[[nodiscard]] double yawError(const vpServoRun &run); //!< Rms.
//! Largest rotation of the reference towards pose 2, relative to the rotation of the goal.
[[nodiscard]] double peakReference(const vpServoRun &run);
//! The same of each new pose, in order, from the goal before it.
[[nodiscard]] std::vector<double> peakReferences(const vpServoRun &run);
//! Mean distance of the reference from the goal over the last second at pose 2.
[[nodiscard]] double referenceLeft(const vpServoRun &run);
[[nodiscard]] double yawRange(const vpServoRun &run);
[[nodiscard]] double idealYawRange(const vpServoRun &run); //!< Range of the goals.
[[nodiscard]] double inView(const vpServoRun &run);        //!< 1 if the object is in view at the end of pose 2.
[[nodiscard]] double yawAtPose2(const vpServoRun &run);    //!< At its end, without sign.
//! Time out of view on the way to pose 2 and at pose 2, s.
[[nodiscard]] double lostAtPose2(const vpServoRun &run);
//! Rms image error along u on the path 1 - 2 - 1, px.
[[nodiscard]] double imageError(const vpServoRun &run);
//! Largest image error along u on this path, px.
[[nodiscard]] double largestImageError(const vpServoRun &run);
//! Mean image error along u over the last second at pose 2 and, back, at pose 1, the larger, px.
[[nodiscard]] double imageErrorLeft(const vpServoRun &run);

constexpr double EQUAL = 0.05;     //!< Two errors that differ by less are "equal"; "clear greater" is more than that.
constexpr double ROUNDING = 0.001; //!< An overshoot is more than that.
constexpr double SAME = 0.01; //!< A ratio of ranges nearer to 1 is not "greater": seeds scatter it by a tenth of that.

//! A ratio of errors that the thesis claims to be "equal or better": at most 1. \param note : Always shown.
[[nodiscard]] Quantity equalOrBetter(const std::string &name, double ours, const std::string &reason,
                                     const std::string &note = "");
//! A ratio that the thesis claims to be above 1. \param by : By how much at least: #EQUAL, #SAME or #ROUNDING.
[[nodiscard]] Quantity greater(const std::string &name, double by, double ours, const std::string &reason,
                               const std::string &note = "");
//! A ratio of Kyrki's law over PBVS that the thesis calls minimal: clearly below 1.
[[nodiscard]] Quantity minimal(const std::string &name, double ours, const std::string &note = "");

//! A number by law.
using Values = std::map<std::string, double>;
//! "PBVS 1, Kyrki 2, feedforward 3 px."
[[nodiscard]] std::string inWords(Values values, const std::string &unit);

//! Reason for what an integral would take away.
constexpr const char *HELD_SHORT = "Friction holds every law without an integral short of its goal.";
//! Image errors that are left, px: PBVS does not reach zero, feedforward does. \param reason : For a difference of either.
[[nodiscard]] std::vector<Quantity> errorsLeft(const std::string &on, Values left, const Values &largest,
                                               const std::string &reason);

/*!
 * \brief Adds rows of further runs to the items: figures 5.8 to 5.11 on AMOR with both references of the drives,
 * figures 5.6 and 5.7 with the noise of section 5.4.3.
 * \param items : Those of servoParts() that are wanted. \param progress : Called with the fraction done.
 */
void addServoRows(const Setting &setting, std::vector<Item> &items, const std::function<void(double)> &progress);
} // namespace thesisReport

#endif
