/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpRedundancyCycle.h
 * \brief One control period of the redundancy solver.
 */
#ifndef vpRedundancyCycle_h
#define vpRedundancyCycle_h

#include "vpLackingAxes.h"
#include "vpTaskLevel.h"

#include <visp3/manipulator/vpJointBounds.h>
#include <visp3/manipulator/vpRedundancySolver.h>

BEGIN_VISP_NAMESPACE

/*!
 * One period for a valid input; see vpRedundancySolver. Working data of an arm of up to N joints, on the stack.
 */
template <int N> class vpRedundancyCycle
{
public:
  using Level = vpTaskLevel<N>;
  using Joints = typename Level::Joints;

  //! \param scale : W^-1/2, zero beyond the last joint. \param lacking : See vpLackingAxes().
  vpRedundancyCycle(const vpArmModel &model, const vpRedundancySpec &spec, const Joints &scale,
                    const vpLackTable &lacking, const vpArmData &data, const vpRedundancyInput &input)
    : m_model(model), m_spec(spec), m_scale(scale), m_lackTable(lacking), m_data(data), m_input(input),
      m_n(model.size())
  {}
  //! Fills the output. False if the tasks have no finite solution: the arm has to brake.
  bool run(vpRedundancyOutput &output) noexcept;

private:
  using Square = typename Level::Square;
  using Rows = typename Level::Rows;
  using Task = typename Level::Task;
  using Escape = vpSingularityEscape<N>;

  // Comparison of the output with the request.
  struct Likeness {
    bool exact = false;  // same velocity
    bool onPath = false; // same direction
  };

  void setMainTask();
  [[nodiscard]] bool isStopped(int i) const { return (m_stopped >> i & 1U) != 0U; }
  [[nodiscard]] bool isSaturated(int i) const { return (m_saturated >> i & 1U) != 0U; }
  [[nodiscard]] Rows moving(Rows B) const;
  void findUnreachable();
  [[nodiscard]] Joints escape(const Rows &B, const Joints &y);
  [[nodiscard]] double shareWithin(const Joints &a, const Joints &b) const;
  [[nodiscard]] double saturate(Joints &y);
  void solveTasks();
  bool stopWorst();
  [[nodiscard]] double scaleWithin() const;
  [[nodiscard]] Joints freeMotion(const Joints &z) const;
  [[nodiscard]] Joints slowlyChanged(const Joints &wanted) const;
  [[nodiscard]] Joints selfMotion() const;
  [[nodiscard]] Likeness compare(vpRedundancyOutput &output) const;
  [[nodiscard]] vpRedundancyStatus judge(bool accelerating, bool clamped, const Likeness &likeness,
                                         const vpRedundancyOutput &output) const;

  const vpArmModel &m_model;
  const vpRedundancySpec &m_spec;
  const Joints m_scale;
  const vpLackTable &m_lackTable;
  const vpArmData &m_data;
  const vpRedundancyInput &m_input;
  const int m_n;

  // Main task in weighted coordinates and scaled units, without the free axes.
  Rows m_B = Rows::Zero();
  Task m_r = Task::Zero();
  std::array<int, 6> m_row{}; // rows of the twist
  int m_rows = 0;
  int m_lacking = 0;              // directions of it for which the arm has no joints
  unsigned int m_unreachable = 0; // axes to free for a task without these
  double m_beyond = 0.;           // part of the task in these directions

  vpJointBounds m_bounds;
  unsigned int m_stopped = 0;       // joints held at a position limit
  Joints m_held = Joints::Zero();   // their velocities
  unsigned int m_saturated = 0;     // joints held at a velocity limit
  double m_share = 1.;              // of the main task, within the velocity limits
  Joints m_motion = Joints::Zero(); // joint velocities for the tasks
  typename Level::Basis m_basis;
  typename Level::Info m_info;
  bool m_escaping = false;
};

END_VISP_NAMESPACE
#endif
