/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpCollisionChecker.h>

BEGIN_VISP_NAMESPACE

bool vpSceneChecker::inCollision(const vpJointVector &q, double margin)
{
  m_scene->place(q, m_data);
  return m_scene->inCollision(m_data, margin);
}

vpClearance vpSceneChecker::clearance(const vpJointVector &q, double cutoff)
{
  m_scene->place(q, m_data);
  return m_scene->clearance(m_data, cutoff);
}

END_VISP_NAMESPACE
