/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpAvoidanceMethods_h
#define vpAvoidanceMethods_h

#include <visp3/avoidance/vpAvoidanceMethod.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief Makes a method for a scene, which outlives it. May throw; may be called by several threads at once.
using vpAvoidanceMethodMaker =
    std::function<std::unique_ptr<vpAvoidanceMethod>(const vpCollisionScene &scene, const vpAvoidanceMethodSpec &spec)>;

//! \ingroup group_avoidance
//! \brief Method names for vpMakeAvoidanceMethod(): ours, then those added.
[[nodiscard]] VISP_EXPORT std::vector<std::string> vpAvoidanceMethodNames();
//! \ingroup group_avoidance
//! \brief How the named method reacts to obstacles, for menus. \throw vpException (badValue) as vpMakeAvoidanceMethod().
[[nodiscard]] VISP_EXPORT std::string vpAvoidanceMethodMessage(const std::string &name);
/*!
 * \ingroup group_avoidance
 * Adds a method of your own, for vpMakeAvoidanceMethod() and all programs. Any thread; cannot be undone, so a library that
 * holds the maker must stay loaded. Its motions are its own responsibility: vpStopSupervisor, behind it, stops the arm before
 * obstacles.
 * \param name : A letter and up to 63 more letters, digits, `-` or `_`.
 * \param sentence : How it reacts to obstacles, one printable line.
 * \param maker : Returns a new method each time; planned motions with a planner of your own are
 *   vpPlannedMotionSpec::planner.
 * \throw vpException (badValue) naming the method, when the name is malformed or used already, or the sentence or maker is
 * empty.
 */
VISP_EXPORT void vpAddAvoidanceMethod(const std::string &name, const std::string &sentence,
                                      vpAvoidanceMethodMaker maker);

/*!
 * \ingroup group_avoidance
 * Creates a method by name, with its own parameters at their defaults.
 *
 * \code
 * for (const std::string &name : vpAvoidanceMethodNames()) {
 *   std::cout << name << ": " << vpAvoidanceMethodMessage(name) << std::endl;
 * }
 * vpAvoidanceMethodSpec spec;
 * spec.maxVelocity = 0.3; // of the tool, m/s
 * const std::unique_ptr<vpAvoidanceMethod> method = vpMakeAvoidanceMethod("planner-dtg", scene, spec);
 * \endcode
 * \param name : One of vpAvoidanceMethodNames().
 * \param scene : Must outlive the method.
 * \param spec : Parameters common to all methods.
 * \throw vpException (badValue) naming an unknown method and the known ones, or a field out of range;
 * whatever the maker of an added method throws.
 */
[[nodiscard]] VISP_EXPORT std::unique_ptr<vpAvoidanceMethod>
vpMakeAvoidanceMethod(const std::string &name, const vpCollisionScene &scene, const vpAvoidanceMethodSpec &spec = {});

END_VISP_NAMESPACE
#endif
