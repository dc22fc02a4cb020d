/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file eye.h
 * \brief The sensor of a run, which records its sightings in the diary.
 */
#ifndef avoidObstacle_eye_h
#define avoidObstacle_eye_h

#include "diary.h"
#include "photoScene.h"

#include "lab/avoidance/vpObstacleSensor.h"

namespace avoidObstacle
{
/*!
 * An eye-in-hand camera (image, depth) or an ideal vision system that detects everything in range (poses).
 * \param scene, options, diary : Must outlive it. \param seed : Noise seed.
 */
[[nodiscard]] std::unique_ptr<vpObstacleSensor> makeEye(const PhotoScene &scene, const Options &options,
                                                        unsigned int seed, Diary &diary);
} // namespace avoidObstacle

#endif
