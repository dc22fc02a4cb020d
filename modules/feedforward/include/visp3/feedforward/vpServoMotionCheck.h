/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoMotionCheck.h
 * \brief What a robot says about a motion that a law plans.
 */
#ifndef vpServoMotionCheck_h
#define vpServoMotionCheck_h

#include <visp3/direct_core/vpTwist.h>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpServoMotionCheck
 * \ingroup group_feedforward
 * \brief The robot's own limits, for laws that plan: is a sequence of camera twists within them?
 *
 * A loop that knows its arm derives from it and passes it to vpServoController::setMotionCheck(). The law asks about each plan before it
 * follows it, a few twists each cycle: begin(), then add() for every twist from now to the end of the plan. It asks
 * from the thread that calls step(); no function may allocate, throw, lock or print.
 *
 * \code
 * class SlowTable : public vpServoMotionCheck // a robot that moves by at most 0.1 m/s
 * {
 * public:
 *   void begin() noexcept override {}
 *   double add(const vpTwist &twist, double) noexcept override { return twist.linearNorm() / 0.1; }
 * };
 * \endcode
 *
 * \code
 * SlowTable table;
 * vpServoController controller = vpServoController::create("ff-dtg");
 * controller.setMotionCheck(&table); // lives as long as the controller
 * controller.setGoal(goal);
 * const vpServoCommand command = controller.step(measurement, dt);
 * if (command.status == vpServoStatus::Degenerate) {
 *   std::cerr << vpMessage(command.status) << std::endl; // no plan within the limits
 * }
 * \endcode
 */
class VISP_EXPORT vpServoMotionCheck
{
public:
  virtual ~vpServoMotionCheck() = default;
  //! A new sequence, from the current state of the robot.
  virtual void begin() noexcept = 0;
  /*!
   * The next twist of the sequence.
   * \param twist : Mean camera twist, in the camera's frame at that time, m/s and rad/s. \param dt : Its duration, s.
   * \return How much faster than allowed the motion is here: at most 1 when it is within all limits; a motion slower by
   *   this factor would be within them. Infinity or NaN when no factor helps (a position limit).
   */
  [[nodiscard]] virtual double add(const vpTwist &twist, double dt) noexcept = 0;
};

END_VISP_NAMESPACE
#endif
