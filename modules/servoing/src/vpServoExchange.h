/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoExchange.h
 * \brief What the vision and the control thread of a vpVisualServo share.
 */
#ifndef vpServoExchange_h
#define vpServoExchange_h

#include "vpObjectMotionFilter.h"
#include "vpPoseHistory.h"
#include "vpTripleBuffer.h"

#include <visp3/servoing/vpVisualServo.h>

#include <atomic>

BEGIN_VISP_NAMESPACE

//! A result on its way to the control thread.
struct vpServoParcel {
  vpServoSight sight;
  vpObjectMotion object;
  bool isFrozen = false; // the image did not change although the camera moved
};

//! Everything that both threads touch; all of it lock-free.
struct vpServoExchange {
  //! Memory for all measurements and goals of up to \e maxPoints points.
  vpServoExchange(std::size_t poses, unsigned int maxPoints) : history(poses)
  {
    sights.forAll([maxPoints](vpServoParcel &parcel) {
      parcel.sight.measurement.points.reserve(maxPoints);
      parcel.sight.measurement.outline.reserve(maxPoints);
      parcel.sight.goal.points.reserve(maxPoints);
    });
    goals.forAll([maxPoints](vpServoGoal &goal) { goal.points.reserve(maxPoints); });
  }

  vpTripleBuffer<vpServoParcel> sights;   // vision -> control
  vpTripleBuffer<vpServoGoal> goals;      // vision -> control
  vpPoseHistory history;                  // control -> vision
  std::atomic<unsigned int> badStamps{0}; // images that were not newer than the last
  std::atomic<unsigned int> epoch{0};     // number of starts
  std::atomic<int> request{0};            // of start() and stop()
  vpServoTiming timing;
};

END_VISP_NAMESPACE
#endif
