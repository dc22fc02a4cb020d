/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlugin.h
 * \brief The one function of a plug-in: a library of your own that programs load by `--plugin LIB.so`.
 */
#ifndef vpPlugin_h
#define vpPlugin_h

#include <visp3/core/vpConfig.h>

/*!
 * \ingroup group_direct_core
 * To be defined by a plug-in: registers what it brings, such as laws by vpServoLaw::add(). A program calls it once, before
 * it reads its other options; an exception ends the program with its sentence. The library stays loaded.
 *
 * \code
 * #include <visp3/direct_core/vpPlugin.h>
 * class Mine : public vpServoLaw
 * {
 * public:
 *   explicit Mine(const vpServoGains &gains) : vpServoLaw("mine", gains) {}
 *
 * protected:
 *   vpServoCommand compute(const vpServoMeasurement &seen, double) noexcept override
 *   {
 *     return {vpTwist(0., 0., m_gains.lambda * (seen.points[0].Z - 0.5), 0., 0., 0.), vpServoStatus::Servoing};
 *   }
 * };
 * extern "C" void vispDirectPlugin()
 * {
 *   vpServoLaw::add("mine", "Half a metre from the first point.",
 *                   [](const vpServoGains &gains, const vpServoMotionLimits &) { return std::make_unique<Mine>(gains); });
 * }
 * \endcode
 * \code{.unparsed}
 * add_library(mine MODULE mine.cpp)
 * target_link_libraries(mine PRIVATE VispDirect::feedforward)
 * \endcode
 *
 * Build it against the visp-direct of the program, as shared libraries: a static one would have a list of laws of its own,
 * which the program does not see. It runs with all rights of the program. What it registers is called in control loops and
 * keeps their rules: a function declared noexcept that throws ends the process by std::terminate(), and the robot's own
 * watchdog has to stop it.
 */
extern "C" VISP_EXPORT void vispDirectPlugin();

#endif
