/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMotionCheck.h"

#include <visp3/avoidance/vpCertifiedMotion.h>
#include <visp3/avoidance/vpDiscreteMotion.h>
#include <visp3/avoidance/vpExactChecker.h>
#include <visp3/avoidance/vpFclChecker.h>

#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
class Certified : public vpMotionCheck
{
public:
  Certified(const vpCollisionScene &scene, const vpPathPlannerSpec &spec)
    : m_checker(scene), m_margin(spec.margin), m_motion(scene, {spec.margin})
  {}
  bool isFree(const vpJointVector &from, const vpJointVector &to) VP_OVERRIDE
  {
    return m_motion.isFree(from, to, m_scratch);
  }
  bool inCollision(const vpJointVector &q) VP_OVERRIDE { return m_checker.inCollision(q, m_margin); }
  vpClearance clearance(const vpJointVector &q, double cutoff) VP_OVERRIDE { return m_checker.clearance(q, cutoff); }

private:
  vpExactChecker m_checker;
  double m_margin;
  vpCertifiedMotion m_motion;
  vpMotionScratch m_scratch;
};

class Discrete : public vpMotionCheck
{
public:
  Discrete(std::unique_ptr<vpCollisionChecker> checker, const vpPathPlannerSpec &spec)
    : m_checker(std::move(checker)), m_margin(spec.margin), m_motion(*m_checker, spec.step, spec.margin)
  {}
  bool isFree(const vpJointVector &from, const vpJointVector &to) VP_OVERRIDE
  {
    return m_motion.check(from, to).isFree();
  }
  bool inCollision(const vpJointVector &q) VP_OVERRIDE { return m_checker->inCollision(q, m_margin); }
  vpClearance clearance(const vpJointVector &q, double cutoff) VP_OVERRIDE { return m_checker->clearance(q, cutoff); }

private:
  std::unique_ptr<vpCollisionChecker> m_checker;
  double m_margin;
  vpDiscreteMotion m_motion;
};
} // namespace

bool vpMotionCheck::isFree(const vpJointPath &path)
{
  bool free = path.points.size() > 1;
  for (std::size_t i = 1; i < path.points.size() && free; ++i) {
    const vpJointVector &a = path.points[i - 1], &b = path.points[i];
    free = isFree(a, b) || isFree(b, a);
  }
  return free;
}

std::unique_ptr<vpMotionCheck> vpMakeMotionCheck(const vpCollisionScene &scene, const vpPathPlannerSpec &spec)
{
  switch (spec.validation) {
  case vpMotionValidation::Discrete:
    return std::make_unique<Discrete>(std::make_unique<vpExactChecker>(scene), spec);
  case vpMotionValidation::DiscreteFcl:
    return std::make_unique<Discrete>(std::make_unique<vpFclChecker>(scene), spec);
  default:
    return std::make_unique<Certified>(scene, spec);
  }
}

END_VISP_NAMESPACE
