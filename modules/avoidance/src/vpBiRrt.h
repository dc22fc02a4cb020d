/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpBiRrt.h
 * \brief RRT-Connect on flat arrays.
 */
#ifndef vpBiRrt_h
#define vpBiRrt_h

#include "vpConfigurationTree.h"
#include "vpHashRandom.h"
#include "vpPathSearch.h"

BEGIN_VISP_NAMESPACE

/*!
 * \brief Bidirectional RRT with the connect heuristic \cite Kuffner00, on any check of motions, then shortcuts.
 *
 * A motion of a tree is as long as OMPL chooses it: at most 0.2 of the box's diagonal. Memory of earlier searches is used
 * again.
 */
class vpBiRrt : public vpPathSearch
{
public:
  explicit vpBiRrt(vpMotionCheck &check) : m_check(&check) {}
  void search(const vpPathProblem &problem, const vpPathPlannerSpec &spec, vpPathResult &result) override;

private:
  enum class Step { Trapped, Advanced, Reached };

  [[nodiscard]] bool connect(const vpPathProblem &problem, const vpPathPlannerSpec &spec);
  [[nodiscard]] Step extend(vpConfigurationTree &tree, const vpJointVector &towards);
  [[nodiscard]] bool isFree(const vpJointVector &from, const vpJointVector &to);
  [[nodiscard]] bool isTimeLeft() const { return vpSecondsSince(m_begin) < m_timeLimit; }
  void shorten(vpJointPath &path, double time);

  vpMotionCheck *m_check;
  vpConfigurationTree m_fromStart, m_fromGoal;
  vpHashRandom m_random{1, vpHashRandom::Purpose::Planner, 0, 0};
  double m_range = 0.;
  double m_timeLimit = 0.;
  std::chrono::steady_clock::time_point m_begin;
  long m_motions = 0;
};

END_VISP_NAMESPACE
#endif
