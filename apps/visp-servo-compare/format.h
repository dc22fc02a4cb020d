/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file format.h
 * \brief Numbers as text, by their short names.
 */
#ifndef servoCompare_format_h
#define servoCompare_format_h

#include "numberText.h"

namespace servoCompare
{
using vpApp::enumerate;
using vpApp::fileName;
using vpApp::fixed;
using vpApp::number;
} // namespace servoCompare

#endif
