/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A sledge with closed-form motion, and a method that drives it without perception.
#ifndef vpMethodsOfTests_h
#define vpMethodsOfTests_h

#include "vpTestArms.h"

#include "lab/avoidance/vpAvoidanceExperiment.h"

#include <limits>

namespace vpMethodsOfTests
{
using Eigen::Vector3d;
using namespace vpTestArms;

constexpr double ball = 0.05; // m, radius of the sledge

//! One prismatic joint along x of the base; a ball at its end, which is the tool.
inline std::shared_ptr<const vpArmModel> sledge()
{
  static const auto model = [] {
    vpArmSpec spec;
    spec.name = "sledge";
    vpArmJointSpec joint;
    joint.name = "rail";
    joint.type = vpJointType::Prismatic;
    joint.before.R << 0., 0., 1., 0., 1., 0., -1., 0., 0.; // z of the joint is x of the base
    joint.lower = -5.;
    joint.upper = 5.;
    joint.velocity = 2.;
    joint.acceleration = 20.;
    spec.joints.push_back(joint);
    spec.capsules.push_back({1, Vector3d::Zero(), Vector3d::Zero(), ball});
    return std::make_shared<const vpArmModel>(spec);
  }();
  return model;
}

inline vpJointVector at(double x) { return vpJointVector::Constant(1, x); }

//! From start to goal by minimum jerk within #duration; stands from #stopFrom until #stopTo, reported as a stop.
class BlindMethod : public vpAvoidanceMethod
{
public:
  struct Spec {
    double duration = 2.;
    double stopFrom = std::numeric_limits<double>::infinity(), stopTo = 0.;
  };
  //! Record of the calls, with their cycles.
  struct Diary {
    int cycle = 0;
    std::vector<int> looks;
    std::vector<vpAvoidanceGoal> goals;
    std::vector<double> seenAt; // x of the first object of the scene in each cycle; NaN: no object
  };

  BlindMethod(const vpCollisionScene &scene, double period, const Spec &spec, std::shared_ptr<Diary> diary)
    : m_scene(&scene), m_period(period), m_spec(spec), m_diary(std::move(diary))
  {}
  vpAvoidanceStatus start(const vpJointVector &q, const vpAvoidanceGoal &goal) override
  {
    m_from = q;
    m_goal = goal;
    return vpAvoidanceStatus::Moving;
  }
  void setGoal(const vpAvoidanceGoal &goal) noexcept override
  {
    m_goal = goal;
    m_diary->goals.push_back(goal);
  }
  void look() override { m_diary->looks.push_back(m_diary->cycle); }
  void step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept override
  {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    m_diary->seenAt.push_back(m_scene->objectCount() > 0 ? m_scene->object(0).pose.p.x() : nan);
    const double now = m_diary->cycle * m_period;
    const bool stop = now >= m_spec.stopFrom && now < m_spec.stopTo;
    m_clock += stop ? 0. : m_period;
    const double s = std::min(1., m_clock / m_spec.duration);
    const vpJointVector next = m_from + s * s * s * (10. - 15. * s + 6. * s * s) * (m_goal.q - m_from);
    output.velocity = stop ? vpJointVector::Zero(q.size()) : vpJointVector((next - q) / m_period);
    output.status = s >= 1. ? vpAvoidanceStatus::Arrived : vpAvoidanceStatus::Moving;
    output.stopping = stop;
    ++m_diary->cycle;
  }

private:
  const vpCollisionScene *m_scene;
  double m_period;
  Spec m_spec;
  std::shared_ptr<Diary> m_diary;
  vpJointVector m_from;
  vpAvoidanceGoal m_goal;
  double m_clock = 0.;
};

//! Run of the sledge from one position to another, blindly; no obstacles yet.
inline vpAvoidanceRunSpec sledgeRun(double from, double to, const BlindMethod::Spec &blind = {},
                                    std::shared_ptr<BlindMethod::Diary> diary = nullptr)
{
  vpAvoidanceRunSpec spec;
  spec.arm = sledge();
  spec.method = "blind";
  spec.start = at(from);
  spec.goal = vpAvoidanceGoal::at(*spec.arm, at(to));
  spec.sight = vpObstacleSight::Exact;
  spec.makeMethod = [blind, diary](const vpCollisionScene &scene, const vpAvoidanceMethodSpec &method) {
    return std::make_unique<BlindMethod>(scene, method.period, blind,
                                         diary ? diary : std::make_shared<BlindMethod::Diary>());
  };
  return spec;
}

//! A ball that moves.
inline vpMovingObstacle movingBall(const Vector3d &from, const Vector3d &velocity, double radius = 0.04)
{
  vpMovingObstacle o;
  o.object.name = "ball";
  o.object.shape = vpCollisionShape::sphere(radius);
  o.object.pose.p = from;
  o.object.velocity = vpTwist(velocity.x(), velocity.y(), velocity.z(), 0., 0., 0.);
  return o;
}
} // namespace vpMethodsOfTests
#endif
