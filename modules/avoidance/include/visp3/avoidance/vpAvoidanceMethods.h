/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpAvoidanceMethods_h
#define vpAvoidanceMethods_h

#include <visp3/avoidance/vpAvoidanceMethod.h>

#include <memory>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief Method names for vpMakeAvoidanceMethod().
[[nodiscard]] VISP_EXPORT const std::vector<std::string> &vpAvoidanceMethodNames();
//! \ingroup group_avoidance
//! Describes how the named method reacts to obstacles, for menus; static text, empty for an unknown name.
[[nodiscard]] VISP_EXPORT const char *vpAvoidanceMethodMessage(const std::string &name) noexcept;

/*!
 * \ingroup group_avoidance
 * Creates a method by name, with its own parameters at their defaults.
 * \param name : One of vpAvoidanceMethodNames().
 * \param scene : Must outlive the method.
 * \param spec : Parameters common to all methods.
 * \throw vpException (badValue) naming an unknown method and the known ones, or a field out of range;
 * (notImplementedError) for planners if built without OMPL.
 */
[[nodiscard]] VISP_EXPORT std::unique_ptr<vpAvoidanceMethod>
vpMakeAvoidanceMethod(const std::string &name, const vpCollisionScene &scene, const vpAvoidanceMethodSpec &spec = {});

END_VISP_NAMESPACE
#endif
