/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpAvoidanceRunSpec.h
 * \brief Specification of an avoidance experiment, with the true motion of its obstacles.
 */
#ifndef vpAvoidanceRunSpec_h
#define vpAvoidanceRunSpec_h

#include "lab/avoidance/vpObstacleSensor.h"

#include <visp3/avoidance/vpAvoidanceMethods.h>
#include <visp3/avoidance/vpCollisionObject.h>
#include <visp3/avoidance/vpObjectTracks.h>
#include <visp3/simulation/vpArmDrives.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \brief True motion of a simulated obstacle: straight on, or back and forth; it may appear and vanish.
 *
 * It does not rotate. Back and forth it moves at the object's velocity, reverses (at constant deceleration, within
 * #turnTime) around the time #turnAfter, and is back at its start at the time 2 #turnAfter.
 */
struct vpMovingObstacle {
  vpCollisionObject object;                                  //!< State (possibly before it appears) at time 0.
  double turnAfter = 0.;                                     //!< Time of reversal, s; 0: never; else > turnTime.
  double turnTime = 0.2;                                     //!< Duration of a reversal, s, > 0.
  double appears = 0.;                                       //!< Time of appearance, s, >= 0.
  double vanishes = std::numeric_limits<double>::infinity(); //!< Time from which it is absent, s, > appears.

  //! \throw vpException (badValue) naming the obstacle, the field that is out of range, and its value.
  void validate() const;
  //! Pose and velocity at time \e t, s; does not allocate.
  void stateAt(double t, vpRigidTransform &pose, vpTwist &velocity) const noexcept;
  //! True if it is present at time \e t, s.
  [[nodiscard]] bool isThere(double t) const noexcept { return t >= appears && t < vanishes; }
};

/*!
 * \brief Straight motion of the goal at constant speed, in position and joints, from its current value to #to.
 */
struct vpGoalMove {
  double begin = 0.;  //!< Start time, s, >= 0 and not before the end of the previous move.
  double end = 0.;    //!< End time, s, >= begin; equal: a jump.
  vpAvoidanceGoal to; //!< Final goal.
};

//! \brief How the method perceives obstacles.
enum class vpObstacleSight {
  Exact, //!< True pose and velocity, with every frame and without latency.
  Poses, //!< Through a vpPoseSensor.
  Custom //!< Through the sensor of vpAvoidanceRunSpec::makeSensor.
};

/*!
 * \brief Everything that determines an avoidance experiment. The same specification gives the same log, bit for bit,
 * unless a time limit ends a search of a path.
 */
struct vpAvoidanceRunSpec {
  std::shared_ptr<const vpArmModel> arm; //!< The arm; not null.
  std::string method = "dtg";            //!< Name for vpMakeAvoidanceMethod(), unless #makeMethod is set.
  vpAvoidanceMethodSpec methodSpec;      //!< Period of the loop, bounds of the tool, margin, seed of planners.
  //! Creates the method instead of vpMakeAvoidanceMethod(); empty: not used. The scene outlives the method.
  std::function<std::unique_ptr<vpAvoidanceMethod>(const vpCollisionScene &, const vpAvoidanceMethodSpec &)> makeMethod;

  vpCollisionSceneSpec scene;              //!< Static scene, known from the start.
  std::vector<vpMovingObstacle> obstacles; //!< Further obstacles, which must be perceived.
  vpJointVector start;                     //!< Start configuration, at rest, rad or m.
  vpAvoidanceGoal goal;                    //!< Goal at time 0.
  std::vector<vpGoalMove> goalMoves;       //!< Goal moves in order of time; empty: the goal rests.
  double goalRate = 50.;                   //!< Rate of goal updates while it moves or is noisy, Hz, > 0.
  //! Standard deviation of each reported coordinate of a moving goal, m, >= 0. Its joints are adapted.
  double goalNoise = 0.;

  vpObstacleSight sight = vpObstacleSight::Poses;                                 //!< Perception of #obstacles.
  vpPoseSensorSpec poses;                                                         //!< Sensor for Poses.
  std::function<std::unique_ptr<vpObstacleSensor>(unsigned int seed)> makeSensor; //!< Sensor for Custom.
  double visionRate = 30.;                        //!< Rate of exposures, Hz, > 0; the first one at time 0.
  double latency = 0.05;                          //!< Latency from exposure to result, s, >= 0.
  std::vector<std::pair<double, double>> covered; //!< Intervals (begin, end) without exposures, s.
  vpObjectTrackSpec tracks;                       //!< Track table between sensor and scene.
  /*!
   * Called with the track table of every period, as the method gets it, and the time, s; empty: not used. For recording
   * only. Not called with vpObstacleSight::Exact, which has no tracks.
   */
  std::function<void(double time, const std::vector<vpObjectTrack> &)> watchTracks;

  vpArmDriveSpec drives;        //!< Drives; ideal by default.
  double maxDuration = 20.;     //!< Maximum duration of the run, s, > 0.
  double goalTolerance = 0.002; //!< Tolerance of the true tool position at the goal, m, > 0.
  unsigned int seed = 1;        //!< Seed of sensor and goal noise.

  vpAvoidanceRunSpec() { drives.ideal = true; }
  //! \throw vpException naming the field that is out of range, and its value.
  void validate() const;
};

END_VISP_NAMESPACE
#endif
