/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file catchObjectAverage.cpp
 * \brief The average of an object over images of a moving camera.
 */
#include "vpCatch.h"
#include "vpPlanTestKit.h"

#include <visp3/feedforward/vpObjectAverage.h>

using namespace vpPlanTestKit;

TEST_CASE("the average of an object is the mean of its images, and follows an object that was moved", "[average]")
{
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(longer(50)); ++problem) {
    auto rng = generator(problem);
    CAPTURE(seed(), problem);
    vpObjectAverage average(20);
    vpHomogeneousMatrix cMo = randomPose(rng, 0.4, 1., 0.3, 1.);
    vpServoMeasurement seen;
    double squares = 0.;
    int count = 0;
    for (int i = 0; i < 400; ++i) {
      measure(noisy(rng, cMo, 0.002, 0.005), square, seen);
      seen.time = 0.1 * (i + 1);
      CHECK(average.see(seen));
      CHECK_FALSE(average.see(seen)); // the same image
      average.predict(seen);
      if (i >= 100) {
        squares += std::pow(translationError(cMo, seen.cMo), 2);
        ++count;
      }
      const vpTwist v = randomTwist(rng, 0.1, 0.3);
      average.move(v, 0.1);
      cMo = move(cMo, v, 0.1);
    }
    // One image: 2 mm and 5 mrad at about 0.7 m; the mean of the last 20, weighted: its deviation over sqrt(39).
    CHECK(std::sqrt(squares / count) < 0.4 * std::hypot(0.002, 0.005));
    cMo = pose(turn(0.3, direction(rng)), 0.1 * direction(rng)) * cMo;
    for (int i = 0; i < 4; ++i) {
      measure(cMo, square, seen);
      seen.time = 100. + i;
      CHECK(average.see(seen));
    }
    average.predict(seen);
    CHECK(translationError(cMo, seen.cMo) < 1e-9);
  }
  CHECK_THROWS_WITH(vpObjectAverage(0), "the window of the object average is 0 images, must be >= 1");
}
