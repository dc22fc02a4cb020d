/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpAvoidanceRunSpec.h
 * \brief What an avoidance experiment runs.
 */
#ifndef vpAvoidanceRunSpec_h
#define vpAvoidanceRunSpec_h

#include <visp3/avoidance/vpAvoidanceMethods.h>
#include <visp3/avoidance/vpObjectTracks.h>
#include <visp3/simulation/vpArmDrives.h>
#include "lab/avoidance/vpMovingObstacle.h"
#include "lab/avoidance/vpPoseSensor.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \brief A goal that moves, straight and at constant speed in place and joints, from where it is to #to.
 */
struct vpGoalMove {
  double begin = 0.;  //!< s, >= 0 and not before the end of the move before.
  double end = 0.;    //!< s, >= begin; equal: it jumps.
  vpAvoidanceGoal to; //!< Where it comes to rest.
};

//! \ingroup group_simulation
//! \brief How obstacles become known to the method.
enum class vpObstacleSight {
  Exact, //!< Place and velocity as they are, with every frame and without latency.
  Poses, //!< By a vpPoseSensor.
  Custom //!< By the sensor of vpAvoidanceRunSpec::makeSensor.
};

/*!
 * \brief Everything that determines an avoidance experiment. The same specification gives the same log, bit for bit,
 * unless a time limit of OMPL ends a search.
 */
struct vpAvoidanceRunSpec {
  std::shared_ptr<const vpArmModel> arm; //!< Must be there.
  std::string method = "dtg";            //!< For makeAvoidanceMethod(), unless there is #makeMethod.
  vpAvoidanceMethodSpec methodSpec;      //!< Period of the loop, bounds of the tool, margin, seed of planners.
  //! Makes the method instead of makeAvoidanceMethod(); empty: not used. The scene outlives the method.
  std::function<std::unique_ptr<vpAvoidanceMethod>(const vpCollisionScene &, const vpAvoidanceMethodSpec &)> makeMethod;

  vpCollisionSceneSpec scene;              //!< What is there, at rest, and known from the start.
  std::vector<vpMovingObstacle> obstacles; //!< What is there besides and has to be seen.
  vpJointVector start;                     //!< At rest, rad or m.
  vpAvoidanceGoal goal;                    //!< At the time 0.
  std::vector<vpGoalMove> goalMoves;       //!< In the order of time; empty: the goal rests.
  double goalRate = 50.;                   //!< While it moves or is noisy the method is told so often, Hz, > 0.
  //! Standard deviation of each coordinate of a goal that moves, as told, m, >= 0. Its joints are made to fit.
  double goalNoise = 0.;

  vpObstacleSight sight = vpObstacleSight::Poses;                                 //!< Of #obstacles.
  vpPoseSensorSpec poses;                                                         //!< For vpObstacleSight::Poses.
  std::function<std::unique_ptr<vpObstacleSensor>(unsigned int seed)> makeSensor; //!< For vpObstacleSight::Custom.
  double visionRate = 30.;                        //!< Exposures, Hz, > 0; the first one at the time 0.
  double latency = 0.05;                          //!< From exposure to result, s, >= 0.
  std::vector<std::pair<double, double>> covered; //!< From when until when nothing is exposed, s.
  vpObjectTrackSpec tracks;                       //!< Track table between sensor and scene.
  /*!
   * Is told the track table of every period, s, as the method gets it; empty: not used. For records; it must not change
   * the run. Not called with vpObstacleSight::Exact, which has no tracks.
   */
  std::function<void(double time, const std::vector<vpObjectTrack> &)> watchTracks;

  vpArmDriveSpec drives;        //!< Ideal unless told otherwise, see the constructor.
  double maxDuration = 20.;     //!< The run ends then, s, > 0.
  double goalTolerance = 0.002; //!< At the goal: the tool's true place is so near, m, > 0.
  unsigned int seed = 1;        //!< Of sensor and goal noise.

  vpAvoidanceRunSpec() { drives.ideal = true; }
  //! \throw vpException naming the field that is out of range, and its value.
  void validate() const;
};

END_VISP_NAMESPACE
#endif
