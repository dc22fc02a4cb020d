/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What must hold of the arm and the objects of a scene, with a sentence that names what does not.
#ifndef vpSceneCheck_h
#define vpSceneCheck_h

#include <visp3/avoidance/vpCollisionScene.h>

BEGIN_VISP_NAMESPACE

// Throws badValue: "source: sentence".
[[noreturn]] void vpSceneFail(const std::string &source, const std::string &sentence);
// Finite and at most 1000 m/s and rad/s.
bool vpIsPlausible(const vpTwist &velocity) noexcept;
// 0 to vpLargestLength.
bool vpIsLength(double value) noexcept;
// Throws naming the object and what is wrong with it.
void vpCheckObject(const std::string &source, const vpCollisionObject &object);
// Throws naming the element of arm or spec that is wrong; objects are left out.
void vpCheckArm(const vpArmModel &arm, const vpCollisionSceneSpec &spec);

END_VISP_NAMESPACE
#endif
