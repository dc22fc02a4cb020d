/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file thesisReplicas.h
 * \brief The experiments of section 7.3.4 of the thesis.
 */
#ifndef printPattern_thesisReplicas_h
#define printPattern_thesisReplicas_h

#include "results.h"

namespace printPattern
{
//! Figures 7.12 to 7.15, and their task with the observer; specifications with seeds, not yet run.
[[nodiscard]] std::vector<Replica> thesisReplicas();
//! Compute the metrics over all finished runs.
void summarise(Replica &replica);
} // namespace printPattern

#endif
