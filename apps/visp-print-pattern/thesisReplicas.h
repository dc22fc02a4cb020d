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
//! Figures 7.12 to 7.15, and the same task with the observer; specifications with their seeds, still to be run.
[[nodiscard]] std::vector<Replica> thesisReplicas();
//! Fill in the figures over all runs, when they are there.
void summarise(Replica &replica);
} // namespace printPattern

#endif
