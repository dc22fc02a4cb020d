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
//! \brief Names for makeAvoidanceMethod().
[[nodiscard]] VISP_EXPORT const std::vector<std::string> &avoidanceMethodNames();
//! \ingroup group_avoidance
//! What a method of that name does when something is in the way, for a list of them; static text, empty when there is none.
[[nodiscard]] VISP_EXPORT const char *avoidanceMethodSentence(const std::string &name) noexcept;

/*!
 * \ingroup group_avoidance
 * A method by name, with its own parameters at their defaults.
 * \param name : One of avoidanceMethodNames().
 * \param scene : Must outlive the method.
 * \param spec : What all methods have in common.
 * \throw vpException (badValue) naming an unknown method with the known ones, or a field out of range;
 * (notImplementedError) for the planners where OMPL was missing.
 */
[[nodiscard]] VISP_EXPORT std::unique_ptr<vpAvoidanceMethod>
makeAvoidanceMethod(const std::string &name, const vpCollisionScene &scene, const vpAvoidanceMethodSpec &spec = {});

END_VISP_NAMESPACE
#endif
