/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpAvoidanceEvaluation.h
 * \brief Metrics of an avoidance experiment.
 */
#ifndef vpAvoidanceEvaluation_h
#define vpAvoidanceEvaluation_h

#include "lab/avoidance/vpClearanceSearch.h"

#include "lab/avoidance/vpAvoidanceExperiment.h"

BEGIN_VISP_NAMESPACE

namespace vpAvoidanceEvaluation
{
//! True if the tool is at the goal and the joints are commanded to rest.
[[nodiscard]] bool isThere(const vpAvoidanceRunSpec &spec, const vpAvoidanceSample &sample);
//! True if the joints are commanded to rest.
[[nodiscard]] bool isAtRest(const vpJointVector &command);
//! Computes all metrics. \param knots : The true motion.
[[nodiscard]] vpAvoidanceMetrics evaluate(const vpAvoidanceRun &run, const std::vector<vpMotionKnot> &knots);
} // namespace vpAvoidanceEvaluation

END_VISP_NAMESPACE
#endif
