/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFaintWall.h
 * \brief Background of simulated cameras.
 */
#ifndef vpFaintWall_h
#define vpFaintWall_h

#include <visp3/core/vpImage.h>
#include <visp3/direct_core/vpDirectCompat.h>

BEGIN_VISP_NAMESPACE

//! A wall far behind the object: smooth and faint, so that it neither resembles the object nor offers keypoints.
vpImage<unsigned char> vpFaintWall(unsigned int width, unsigned int height);

END_VISP_NAMESPACE
#endif
