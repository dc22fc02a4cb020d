/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMotionForm.h
 * \brief Forms of motion of a user's own, checked before they are used.
 */
#ifndef vpMotionForm_h
#define vpMotionForm_h

#include <visp3/trajectory/vpPolynomial.h>
#include <visp3/trajectory/vpTrajectoryPlan.h>
#include <visp3/trajectory/vpTrajectoryProblem.h>

#include <memory>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpMotionForm
 * \ingroup group_trajectory
 * \brief A form of motion of your own, named by vpTrajectorySpec::form, for motions without vias to a goal at rest.
 *
 * vpTrajectoryPlanner asks it first, and uses its motion only if that is a valid answer:
 * - it starts in the start state and ends in the goal, and its pieces join, in all derivatives of
 *   vpTrajectorySpec::continuity, to 1e-9 of their peaks;
 * - all limits are kept, by the same exact check as for our own motions;
 * - it lasts at least the minimum duration, with vpReplanPolicy::FixedArrival exactly the given time, and the axes arrive
 *   together, unless vpSynchronisation::None.
 *
 * Otherwise the planner's own motion is used, as for starts outside the limits, for goals that move, for vias and
 * vpSynchronisation::Straight. vpTrajectoryPlan::form() tells: vpTrajectoryForm::Own. The functions planDirect() and the
 * iteration of the thesis do not ask it.
 *
 * Forms are called in real-time steps, by several threads at once: hence const, without scratch memory.
 *
 * \code
 * class Septic : public vpMotionForm // from rest to rest, with jerk 0 at both ends
 * {
 * public:
 *   bool plan(const vpTrajectoryProblem &problem, double floor, Writer &writer) const noexcept override
 *   {
 *     double T = floor; // s, for all axes
 *     for (int i = 0; i < problem.axes(); ++i) {
 *       const double h = std::abs(problem.goal(i)[0] - problem.start(i)[0]);
 *       const vpAxisLimits limits = problem.limits(i);
 *       T = std::max({T, 2.1875 * h / limits.velocity, std::sqrt(7.5133 * h / limits.acceleration)});
 *     }
 *     for (int i = 0; i < problem.axes(); ++i) {
 *       const double h = problem.goal(i)[0] - problem.start(i)[0];
 *       writer.append(i, {0., 0., 0., 0., 35. * h, -84. * h, 70. * h, -20. * h}, T);
 *     }
 *     return true;
 *   }
 * };
 * \endcode
 *
 * \code
 * vpMotionForm::add("septic", "A polynomial of degree seven, from rest to rest.", std::make_unique<Septic>());
 * vpTrajectoryInput<1> input;
 * input.goal.q << 0.5; // m
 * input.spec.form = vpMotionForm::find("septic");
 * vpTrajectoryPlan plan(1);
 * const vpTrajectoryStatus status = vpDirectTrajectory<1>::calculate(input, plan);
 * std::cout << status.message() << ", " << vpToString(plan.form()) << std::endl; // Own, if it passed the check
 * \endcode
 */
class VISP_EXPORT vpMotionForm
{
public:
  //! \brief Receives the pieces of the motion.
  class VISP_EXPORT Writer
  {
  public:
    //! Appends a piece to an axis: position in s = 0 ... 1 relative to the end of the piece before, of degree 8 at most, and
    //! its duration, s. Ignored beyond that, and where there is no room for it: at least 26 pieces an axis fit.
    void append(int axis, const vpPolynomial &relative, double duration) noexcept;

  private:
    friend class vpMotionForm;
    explicit Writer(vpTrajectoryPlan &plan) : m_plan(plan) {}
    vpTrajectoryPlan &m_plan;
  };

  virtual ~vpMotionForm() = default;
  vpMotionForm(const vpMotionForm &) = delete;
  vpMotionForm &operator=(const vpMotionForm &) = delete;

  /*!
   * A motion for each axis of \e problem, of at least \e floor s. Must not throw, allocate or lock.
   * \return False when the form has none.
   */
  virtual bool plan(const vpTrajectoryProblem &problem, double floor, Writer &writer) const noexcept = 0;

  //! Names of the forms that were added.
  [[nodiscard]] static std::vector<std::string> names();
  //! What a form is, one sentence. \throw vpException (badValue) naming the unknown form and the known ones.
  [[nodiscard]] static std::string sentence(const std::string &name);
  //! The form, for vpTrajectorySpec::form; exists until the program ends. \throw vpException (badValue) as sentence().
  [[nodiscard]] static const vpMotionForm *find(const std::string &name);
  /*!
   * Adds a form. Any thread; cannot be undone, so a library that holds it must stay loaded.
   * \param name : A letter and up to 63 more letters, digits, `-` or `_`. \param sentence : What it is, one printable line.
   * \param form : The form.
   * \throw vpException (badValue) naming the form, when the name is malformed or used already, or the sentence or form is
   * empty.
   */
  static void add(const std::string &name, const std::string &sentence, std::unique_ptr<const vpMotionForm> form);

protected:
  vpMotionForm() = default;

private:
  friend class vpTrajectoryPlanner;
  // The form's motion if it passes the check; the plan is undefined otherwise.
  bool isValid(const vpTrajectoryProblem &problem, double floor, vpTrajectoryPlan &plan) const noexcept;
};

END_VISP_NAMESPACE
#endif
