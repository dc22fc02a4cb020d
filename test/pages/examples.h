// visp-direct: direct methods for vision-based robot control, for ViSP.
// SPDX-License-Identifier: GPL-2.0-or-later
// What the examples of the public headers take as given, see checkExamples.py: nothing here is defined.
#include <visp3/core/vpFrameGrabber.h>
#include <visp3/robot/vpRobot.h>

#include <iostream>
#include <memory>
#include <thread>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

extern vpFrameGrabber &grabber; // the reader's camera and robot
extern vpRobot &robot;
extern const vpCameraParameters camera;
extern vpImage<unsigned char> image, photo, reference;
double now();                                      // s
vpJointVector encoders();                          // rad or m
template <class... Numbers> void send(Numbers...); // to drives or print head

extern const vpArmModel arm;
extern vpJointVector q, goal;        // rad or m
extern vpJointVector velocity, wish; // rad/s or m/s
extern vpCollisionScene scene;

extern vpServoLaw &law;
extern const vpHomogeneousMatrix cdMo;
extern vpServoMeasurement measurement;
extern const double dt; // s

namespace avoidance
{
extern vpImage<float> depth; // m
}

namespace feedforward
{
extern const vpServoGoal goal;
extern const vpMatrix eJe;
bool closeEnough(const vpServoMeasurement &seen);
} // namespace feedforward

namespace printing
{
extern const std::vector<vpFrictionSample> samples; // force, velocity, acceleration
}

namespace servoing
{
extern bool isRunning;
}
