/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file eye.h
 * \brief The sensor of a run, which writes into its diary what it sees.
 */
#ifndef avoidObstacle_eye_h
#define avoidObstacle_eye_h

#include "diary.h"
#include "photoScene.h"

#include "lab/avoidance/vpObstacleSensor.h"

namespace avoidObstacle
{
/*!
 * A camera in the hand (image, depth) or a vision system that always finds what is in range (poses).
 * \param scene, options, diary : Must outlive it. \param seed : Of its noise.
 */
[[nodiscard]] std::unique_ptr<vpObstacleSensor> makeEye(const PhotoScene &scene, const Options &options,
                                                        unsigned int seed, Diary &diary);
} // namespace avoidObstacle

#endif
