/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file loggingSensor.h
 * \brief The sensor of a run, which records its sightings in the sensorLog.
 */
#ifndef avoidObstacle_loggingSensor_h
#define avoidObstacle_loggingSensor_h

#include "sensorLog.h"
#include "photoScene.h"

#include "lab/avoidance/vpObstacleSensor.h"

namespace avoidObstacle
{
/*!
 * An eye-in-hand camera (image, depth) or an ideal vision system that detects everything in range (poses).
 * \param scene, options, sensorLog : Must outlive it. \param seed : Noise seed.
 */
[[nodiscard]] std::unique_ptr<vpObstacleSensor> makeLoggingSensor(const PhotoScene &scene, const Options &options,
                                                                  unsigned int seed, SensorLog &sensorLog);
} // namespace avoidObstacle

#endif
