/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPathShortcuts.h
 * \brief Shorter paths by random shortcuts.
 */
#ifndef vpPathShortcuts_h
#define vpPathShortcuts_h

#include "vpHashRandom.h"
#include "vpMotionCheck.h"

#include <chrono>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Shortens a path: leaves out points and joins random places of it, wherever the straight motion is free
 * \cite Geraerts07.
 * Pieces of the motions that are left are not checked again.
 */
class vpPathShortcuts
{
public:
  vpPathShortcuts(vpMotionCheck &check, vpHashRandom &random) : m_check(&check), m_random(&random) {}

  //! Ends at the time, s from now, or when shortcuts are no longer found. Never makes the path longer.
  void apply(vpJointPath &path, double time);
  //! Number of motions checked.
  [[nodiscard]] long motions() const noexcept { return m_motions; }

private:
  [[nodiscard]] bool isTimeLeft() const;
  [[nodiscard]] bool isFree(const vpJointVector &from, const vpJointVector &to);
  void leaveOutPoints(vpJointPath &path);
  [[nodiscard]] double join(vpJointPath &path);

  vpMotionCheck *m_check;
  vpHashRandom *m_random;
  std::chrono::steady_clock::time_point m_end;
  long m_motions = 0;
};

END_VISP_NAMESPACE
#endif
