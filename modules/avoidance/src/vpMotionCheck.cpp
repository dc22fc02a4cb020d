/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMotionCheck.h"

#include "vpFclMotionCheck.h"

#include <visp3/avoidance/vpCertifiedMotion.h>
#include <visp3/avoidance/vpDiscreteMotion.h>

BEGIN_VISP_NAMESPACE

namespace
{
class Certified : public vpMotionCheck
{
public:
  Certified(const vpCollisionScene &scene, const vpPathPlannerSpec &spec)
    : m_checker(scene), m_margin(spec.margin), m_motion(scene, {spec.margin})
  {}
  vpMotionResult motion(const vpJointVector &from, const vpJointVector &to) VP_OVERRIDE
  {
    return m_motion.check(from, to, m_scratch);
  }
  bool inCollision(const vpJointVector &q) VP_OVERRIDE { return m_checker.inCollision(q, m_margin); }

private:
  vpSceneChecker m_checker;
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
  vpMotionResult motion(const vpJointVector &from, const vpJointVector &to) VP_OVERRIDE
  {
    return m_motion.check(from, to);
  }
  bool inCollision(const vpJointVector &q) VP_OVERRIDE { return m_checker->inCollision(q, m_margin); }

private:
  std::unique_ptr<vpCollisionChecker> m_checker;
  double m_margin;
  vpDiscreteMotion m_motion;
};
} // namespace

std::unique_ptr<vpMotionCheck> vpMotionCheck::create(const vpCollisionScene &scene, const vpPathPlannerSpec &spec)
{
  switch (spec.validation) {
  case vpMotionValidation::Discrete:
    return std::make_unique<Discrete>(std::make_unique<vpSceneChecker>(scene), spec);
  case vpMotionValidation::DiscreteFcl:
    return std::make_unique<Discrete>(vpFclMotionCheck::makeChecker(scene), spec);
  default:
    return std::make_unique<Certified>(scene, spec);
  }
}

END_VISP_NAMESPACE
