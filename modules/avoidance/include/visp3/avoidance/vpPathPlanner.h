/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPathPlanner.h
 * \brief Collision-free paths in joint space, by a planner of our own and those of OMPL.
 */
#ifndef vpPathPlanner_h
#define vpPathPlanner_h

#include <visp3/avoidance/vpCollisionScene.h>
#include <visp3/avoidance/vpJointPath.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ompl
{
namespace base
{
class Planner;
class SpaceInformation;
} // namespace base
} // namespace ompl

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief How a planner checks the motion between two configurations.
enum class vpMotionValidation {
  Certified,  //!< vpCertifiedMotion: free motions are proven free. The default.
  Discrete,   //!< vpDiscreteMotion on the fast path: collisions between samples are missed.
  DiscreteFcl //!< vpDiscreteMotion on FCL, as in most planners; requires a build with FCL.
};

/*!
 * \ingroup group_avoidance
 * \brief Parameters of vpPathPlanner.
 */
struct VISP_EXPORT vpPathPlannerSpec {
  //! One of vpPathPlanner::names(). BiRRT is the fastest; RRT*, BIT* keep improving until the time limit.
  std::string planner = "BiRRT";
  vpMotionValidation validation = vpMotionValidation::Certified; //!< Check of motions.
  double margin = 0.005;                                         //!< Clearance to keep, m, >= 0.
  double step = 0.05;    //!< Discrete validation: largest change of a joint between samples, rad or m, > 0.
  double timeLimit = 2.; //!< Maximum planning time, s, > 0.
  //! Maximum number of iterations of the planner's loop, repeatable on any machine; 0: only the time limit.
  unsigned int iterations = 0;
  bool stopAtFirst = true;  //!< RRT* and BIT*: false keeps improving until the time limit.
  double range = 0.;        //!< Longest motion of a tree, rad or m, >= 0; 0: 0.2 of the diagonal of all positions.
  double shortenTime = 0.2; //!< Maximum time for shortening a path, s, >= 0; 0: none.
  unsigned int seed = 1;    //!< Seed of the sampling, >= 1. Runs repeat unless ended by a time limit.

  /*!
   * \throw vpException (badValue) naming the field that is out of range, and its value; for an unknown planner also
   * the known ones.
   */
  void validate() const;
};

//! \ingroup group_avoidance
//! \brief Result of planning.
enum class vpPathStatus {
  Solved,           //!< A path was found.
  StartInCollision, //!< At the start the arm is nearer to an obstacle, the ground or itself than the margin.
  GoalInCollision,  //!< At the goal the arm is nearer to an obstacle, the ground or itself than the margin.
  OutsideLimits,    //!< Start or goal is outside the position limits.
  TimedOut,         //!< No path was found in time; one may still exist.
  NotFree,          //!< A planner of the user's own returned a path that does not pass the check of motions.
  BadInput          //!< A configuration of the wrong size or not finite.
};

/*!
 * \ingroup group_avoidance
 * \brief Result of a planner.
 */
struct VISP_EXPORT vpPathResult {
  vpPathStatus status = vpPathStatus::BadInput; //!< Only Solved has a path.
  vpJointPath path;                             //!< Path from start to goal; a continuous joint may pass +-pi.
  double planningTime = 0.;                     //!< Planning time, s.
  double shortenTime = 0.;                      //!< Time for shortening, s.
  long motions = 0;                             //!< Number of motions checked.
  std::string message;                          //!< Readable result, with the obstructing pair.
};

/*!
 * \class vpPathPlanner
 * \ingroup group_avoidance
 * \brief Plans joint-space paths of a scene's arm, with the object poses at the call of plan().
 *
 * BiRRT is RRT-Connect \cite Kuffner00 on flat arrays, with random shortcuts \cite Geraerts07, and needs no other
 * library. The others are those of OMPL \cite Sucan12, paths shortened by its PathSimplifier; they take some 0.1 ms
 * more for each plan.
 *
 * Continuous joints take the shorter way to the goal's angle; the path never crosses position limits. A path found
 * with certified validation is free with the margin at every point, thesis (3.46), (3.48); with discrete validation
 * it may not be. Where the scene has exact shapes (vpCollisionSceneSpec::exact) they decide where capsules touch,
 * except with DiscreteFcl; a path that passes there cannot be proven by vpCertifiedTrajectory, nor timed by
 * vpTimedPath. One object per thread.
 *
 * \code
 * vpPathPlannerSpec spec;
 * spec.margin = 0.01; // m
 * vpPathPlanner planner(scene, spec);
 * const vpPathResult found = planner.plan(q, goal);
 * std::cout << found.message << std::endl; // also why there is no path
 * if (found.status == vpPathStatus::Solved) {
 *   std::cout << found.path.points.size() << " points, " << found.path.length() << " rad" << std::endl;
 * }
 * \endcode
 */
class VISP_EXPORT vpPathPlanner
{
public:
  /*!
   * Makes an OMPL planner for a joint space whose checks of states and motions are set already; the problem is set
   * afterwards. Called once for each search, by any thread, but never twice at the same time.
   */
  using Maker = std::function<std::shared_ptr<ompl::base::Planner>(
      const std::shared_ptr<ompl::base::SpaceInformation> &space, const vpPathPlannerSpec &spec)>;

  //! Names of the planners: BiRRT; RRT, RRTConnect, RRTstar, PRM, BITstar, KPIECE of OMPL, also in a build without it;
  //! then those added.
  [[nodiscard]] static std::vector<std::string> names();
  //! How a planner works, one sentence. \throw vpException (badValue) naming the unknown planner and the known ones.
  [[nodiscard]] static std::string sentence(const std::string &name);
  /*!
   * Adds a planner of your own, for vpPathPlannerSpec::planner. Any thread; cannot be undone, so a library that holds
   * the maker must stay loaded. Its paths are checked as a whole before they are used: NotFree.
   * \param name : A letter and up to 63 more letters, digits, `-` or `_`.
   * \param sentence : How it works, one printable line.
   * \param maker : Uses the same OMPL as visp-direct.
   * \throw vpException (badValue) naming the planner, when the name is malformed or used already, or the sentence or
   * maker is empty.
   */
  static void add(const std::string &name, const std::string &sentence, Maker maker);

  /*!
   * \param scene : Must outlive the planner.
   * \param spec : Parameters; copied.
   * \throw vpException (badValue), see vpPathPlannerSpec::validate(); (notImplementedError) naming OMPL or FCL if
   * built without it, for any planner but BiRRT and for DiscreteFcl.
   */
  explicit vpPathPlanner(const vpCollisionScene &scene, const vpPathPlannerSpec &spec = {});
  ~vpPathPlanner();
  vpPathPlanner(vpPathPlanner &&) noexcept;            //!< Moves.
  vpPathPlanner &operator=(vpPathPlanner &&) noexcept; //!< Moves.
  vpPathPlanner(const vpPathPlanner &) = delete;
  vpPathPlanner &operator=(const vpPathPlanner &) = delete;

  //! Plans from \e start to \e goal (n numbers each, rad or m). A value beyond a position limit L by at most
  //! 1e-9 max(1, |L|) counts as at the limit. Allocates. \throw whatever the maker of an added planner throws.
  [[nodiscard]] vpPathResult plan(const vpJointVector &start, const vpJointVector &goal);
  //! Sets the maximum planning time, s; values that are not > 0 are ignored.
  void setTimeLimit(double seconds) noexcept;
  //! Sets the seed, for a different attempt; 0 is ignored.
  void setSeed(unsigned int seed) noexcept;
  //! The parameters.
  [[nodiscard]] const vpPathPlannerSpec &spec() const noexcept;

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
