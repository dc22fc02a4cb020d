/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoLaws.h
 * \brief Factory functions of the laws, one family per source file; only called by vpServoLaw::create().
 */
#ifndef vpServoLaws_h
#define vpServoLaws_h

#include <visp3/feedforward/vpServoLaw.h>

BEGIN_VISP_NAMESPACE

namespace vpServoLaws
{
//! Rotation gain of the look-at laws relative to lambda, beside vpServoGains::rotation.
constexpr double lookAtFactor = 2.;

using Maker = std::unique_ptr<vpServoLaw> (*)(const std::string &id, const vpServoGains &gains, double rotationFactor);

std::unique_ptr<vpServoLaw> makePbvs1(const std::string &id, const vpServoGains &gains, double rotationFactor);
std::unique_ptr<vpServoLaw> makePbvs2(const std::string &id, const vpServoGains &gains, double rotationFactor);
std::unique_ptr<vpServoLaw> makeIbvs(const std::string &id, const vpServoGains &gains, double rotationFactor);
std::unique_ptr<vpServoLaw> makeHybrid25d(const std::string &id, const vpServoGains &gains, double rotationFactor);
std::unique_ptr<vpServoLaw> makeKyrki(const std::string &id, const vpServoGains &gains, double rotationFactor);
std::unique_ptr<vpServoLaw> makeKyrkiDecoupled(const std::string &id, const vpServoGains &gains, double rotationFactor);
std::unique_ptr<vpServoLaw> makeFeedforwardSum(const std::string &id, const vpServoGains &gains, double rotationFactor);
std::unique_ptr<vpServoLaw> makeLookAt(const std::string &id, const vpServoGains &gains, double rotationFactor);
std::unique_ptr<vpServoLaw> makeLookAtPi(const std::string &id, const vpServoGains &gains, double rotationFactor);
std::unique_ptr<vpServoLaw> makeDtg(const vpServoGains &gains, const vpServoMotionLimits &motion);
std::unique_ptr<vpServoLaw> makeFeedforwardDtg(const vpServoGains &gains, const vpServoMotionLimits &motion);
} // namespace vpServoLaws

END_VISP_NAMESPACE
#endif
