/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpPotentialFieldAvoidance.h>

#include "vpFieldCheck.h"
#include "vpStopPlan.h"
#include "vpToolMotion.h"

#include <visp3/avoidance/vpPotentialField.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the potential field");
using Eigen::Vector3d;
constexpr double still = 2e-3; // m/s: a slower tool counts as standing

//! The arm as in the text: no velocity and acceleration limits.
vpArmModel withoutMotionLimits(const vpArmModel &arm)
{
  vpArmSpec spec = arm.spec();
  for (vpArmJointSpec &joint : spec.joints) {
    joint.velocity = 1e3;
    joint.acceleration = 1e6;
  }
  return vpArmModel(spec);
}

double signOf(double x) { return x < 0. ? -1. : 1.; }
} // namespace

void vpFieldWeightSpec::validate(vpFieldForm form) const
{
  fields.positive("centre", centre);
  fields.positive("width", width);
  fields.positive("height", height);
  fields.require(std::isfinite(height) && (form == vpFieldForm::Thesis || height == 0.5), "height", height,
                 "0.5 in the corrected form");
}

double vpFieldWeight(const vpFieldWeightSpec &spec, vpFieldForm form, double distance) noexcept
{
  if (std::isnan(distance)) { // as in contact
    return vpFieldWeight(spec, form, 0.);
  }
  const double d = form == vpFieldForm::Thesis ? distance : std::max(0., distance);
  const double w =
      spec.height * (std::tanh((d + spec.centre) / spec.width) - std::tanh((d - spec.centre) / spec.width));
  return form == vpFieldForm::Thesis ? w : std::min(1., w / std::tanh(spec.centre / spec.width));
}

Eigen::Vector3d vpBlendAsPrinted(const vpFieldWeightSpec &spec, const Eigen::Vector2d &offset,
                                 const Eigen::Vector3d &avoid, const Eigen::Vector3d &task) noexcept
{
  Eigen::Vector3d result = task;
  for (int l = 0; l < 2; ++l) {
    const double w = vpFieldWeight(spec, vpFieldForm::Thesis, offset(l));
    result(l) = w * avoid(l) + (1. - w) * task(l);
  }
  return result;
}

Eigen::Vector3d vpBlendRadial(const vpFieldWeightSpec &spec, double distance, const Eigen::Vector3d &normal,
                              double speed, const Eigen::Vector3d &task) noexcept
{
  const double w = vpFieldWeight(spec, vpFieldForm::Corrected, distance);
  const double along = task.dot(normal); // < 0: towards the obstacle
  const double blended = w * speed + (1. - w) * along;
  return task + (std::max(along, blended) - along) * normal;
}

void vpPotentialFieldAvoidanceSpec::validate() const
{
  common.validate();
  metres.validate(vpFieldForm::Corrected);
  pixels.validate(vpFieldForm::Thesis);
  fields.positive("gain", gain);
  fields.positive("avoidSpeed", avoidSpeed);
  fields.positive("focal", focal);
  fields.positive("imageWidth", imageWidth);
  fields.positive("imageHeight", imageHeight);
  fields.positive("sight", sight);
  fields.positive("tolerance", tolerance);
}

class vpPotentialFieldAvoidance::Impl
{
public:
  Impl(const vpCollisionScene &s, const vpPotentialFieldAvoidanceSpec &p)
    : scene(&s), spec(p), arm(p.form == vpFieldForm::Thesis ? withoutMotionLimits(s.arm()) : s.arm()),
      motion(arm, motionSpec(p))
  {
    spec.validate();
    scene->arm().requireMotionLimits("a potential field");
    for (const vpArmCapsule &capsule : arm.spec().capsules) {
      last = std::max(last, capsule.link);
    }
  }

  //! Evaluated in the placed configuration.
  void step(vpAvoidanceOutput &output) noexcept
  {
    scene->near(data, cutoff(), near);
    const Vector3d x = data.arm.tool.p;
    const Vector3d error = goal.position - x;
    Vector3d task = spec.gain * error;
    bool avoiding = false;
    output.pair = vpClearance();
    const Vector3d velocity = spec.form == vpFieldForm::Thesis ? asPrinted(task, avoiding) //
                                                               : radial(task, avoiding, output.pair);
    const bool there = error.norm() <= spec.tolerance;
    motion.step(data, near, velocity, goal.q, data.arm.tool.R, previous, solved, !(stood && there));
    output.velocity = previous = solved.velocity;
    const Vector3d moved = data.arm.J.topRows<3>() * solved.velocity;
    output.wanted = x + spec.common.period * moved;
    const bool stands = stood = moved.norm() < still;
    output.status = stands && there && previous.norm() < vpToolMotion::jointRest ? vpAvoidanceStatus::Arrived
                    : stands && !there && !starting                              ? vpAvoidanceStatus::Waiting
                    : avoiding                                                   ? vpAvoidanceStatus::Detouring
                                                                                 : vpAvoidanceStatus::Moving;
    starting = starting && stands;
  }

  //! The obstacle nearest to the image's centre, if its own centre is in the image.
  Vector3d asPrinted(const Vector3d &task, bool &avoiding) const noexcept
  {
    const vpRigidTransform fMc = vpArmKinematics::camera(arm, data.arm);
    Eigen::Vector2d nearest = Eigen::Vector2d::Constant(1e6);
    for (int i = 0; i < scene->objectCount(); ++i) {
      const Vector3d p = fMc.R.transpose() * (scene->object(i).pose.p - fMc.p);
      if (p.z() <= 0. || p.z() > spec.sight) {
        continue;
      }
      const Eigen::Vector2d offset = spec.focal * p.head<2>() / p.z();
      const bool seen = std::fabs(offset.x()) < 0.5 * spec.imageWidth && std::fabs(offset.y()) < 0.5 * spec.imageHeight;
      nearest = seen && offset.norm() < nearest.norm() ? offset : nearest;
    }
    if (nearest.x() >= 1e6) {
      return task;
    }
    avoiding = true;
    const Vector3d away(-spec.avoidSpeed * signOf(nearest.x()), -spec.avoidSpeed * signOf(nearest.y()), 0.);
    return fMc.R * vpBlendAsPrinted(spec.pixels, nearest, away, fMc.R.transpose() * task);
  }

  //! All obstacles near the last link, the nearest last: it decides.
  Vector3d radial(const Vector3d &task, bool &avoiding, vpClearance &nearest) noexcept
  {
    Vector3d velocity = task;
    const double limit = spec.common.maxVelocity;
    velocity *= std::min(1., limit / std::max(1e-9, velocity.norm()));
    const auto begin = near.pairs.begin(), end = begin + near.count;
    std::sort(begin, end, [](const vpClearance &a, const vpClearance &b) { return a.distance > b.distance; });
    for (auto pair = begin; pair != end; ++pair) {
      const bool counts = pair->kind == vpCollisionKind::Object || pair->kind == vpCollisionKind::Ground;
      if (!counts || arm.spec().capsules[static_cast<std::size_t>(pair->capsule)].link != last) {
        continue;
      }
      const double distance = pair->distance - spec.common.margin;
      velocity = vpBlendRadial(spec.metres, distance, pair->normal, spec.avoidSpeed, velocity);
      avoiding = avoiding || vpFieldWeight(spec.metres, spec.form, distance) > 0.05;
      nearest = *pair;
    }
    return velocity * std::min(1., limit / std::max(1e-9, velocity.norm()));
  }

  const vpCollisionScene *scene;
  vpPotentialFieldAvoidanceSpec spec;
  vpArmModel arm;
  vpToolMotion motion;
  int last = 0; // link that carries the outermost capsule
  vpAvoidanceGoal goal;
  vpJointVector previous;
  bool starting = true, stood = false, valid = false; // stood: the tool did in the last period
  vpCollisionData data;
  vpNearPairs near;
  vpRedundancyOutput solved;

private:
  static vpToolMotionSpec motionSpec(const vpPotentialFieldAvoidanceSpec &spec)
  {
    vpToolMotionSpec result;
    result.period = spec.common.period;
    return result;
  }
  double cutoff() const noexcept { return spec.common.margin + spec.metres.centre + 3. * spec.metres.width; }
};

vpPotentialFieldAvoidance::vpPotentialFieldAvoidance(const vpCollisionScene &scene,
                                                     const vpPotentialFieldAvoidanceSpec &spec)
  : m_impl(std::make_unique<Impl>(scene, spec))
{}
vpPotentialFieldAvoidance::~vpPotentialFieldAvoidance() = default;

vpAvoidanceStatus vpPotentialFieldAvoidance::start(const vpJointVector &q, const vpAvoidanceGoal &goal)
{
  const int n = m_impl->arm.size();
  m_impl->scene->place(q, m_impl->data);
  m_impl->valid = m_impl->data.placed && goal.fits(m_impl->arm);
  m_impl->previous = vpJointVector::Zero(n);
  m_impl->starting = true;
  m_impl->stood = false;
  m_impl->goal = goal;
  return m_impl->valid ? vpAvoidanceStatus::Moving : vpAvoidanceStatus::InvalidInput;
}

void vpPotentialFieldAvoidance::setGoal(const vpAvoidanceGoal &goal) noexcept
{
  if (goal.fits(m_impl->arm)) {
    m_impl->goal = goal;
  }
}

void vpPotentialFieldAvoidance::step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept
{
  const int n = m_impl->arm.size();
  output = vpAvoidanceOutput();
  output.velocity = vpJointVector::Zero(n);
  if (!m_impl->valid) {
    return;
  }
  m_impl->scene->place(q, m_impl->data);
  if (m_impl->data.placed) {
    m_impl->step(output);
  }
  else {
    output.velocity = m_impl->previous = brakeOnce(m_impl->arm, m_impl->previous, m_impl->spec.common.period);
  }
}

END_VISP_NAMESPACE
