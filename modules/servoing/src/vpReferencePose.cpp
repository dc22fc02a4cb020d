/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/servoing/vpReferencePose.h>

#include "vpReferenceHypotheses.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/servoing/vpServoTarget.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numeric>
#include <utility>

BEGIN_VISP_NAMESPACE

const vpFields<vpReferencePoseSpec> &vpReferencePoseSpec::fields()
{
  using Spec = vpReferencePoseSpec;
  static const vpFields<Spec> table = {
      {"nearest", &Spec::nearest, vpFieldRange::positive(1000.), "m",
       "Smallest distance d that the reference camera may have from the plane"},
      {"farthest", &Spec::farthest, vpFieldRange::positive(1000.), "m", "Largest distance, at least nearest"},
      {"caution", &Spec::caution, vpFieldRange::notNegative(10.), "",
       "Number of standard deviations of 1/d by which the scale is on the near side"},
      {"tilt", &Spec::tilt, vpFieldRange::positive(10.), "rad",
       "Standard deviation of the plane's tilt against the reference image"},
      {"slowness", &Spec::slowness, vpFieldRange::positive(1.), "",
       "Factor on the speed while two planes explain the images"},
      {"minPoints", &Spec::minPoints, {5., 1000.}, "", "Fewest visible points of an image that is used"},
  };
  return table;
}

void vpReferencePoseSpec::validate() const
{
  vpCheckFields(*this, fields(), "the reference pose");
  if (!(farthest >= nearest)) {
    throw vpException(vpException::badValue, "farthest of the reference pose is %g m, must be at least nearest, %g m",
                      farthest, nearest);
  }
}

const char *vpToString(vpReferenceStatus status)
{
  switch (status) {
  case vpReferenceStatus::Unique:
    return "Unique";
  case vpReferenceStatus::Ambiguous:
    return "Ambiguous";
  case vpReferenceStatus::PureRotation:
    return "PureRotation";
  case vpReferenceStatus::TooFewPoints:
    return "TooFewPoints";
  case vpReferenceStatus::NoOdometry:
    return "NoOdometry";
  case vpReferenceStatus::Inconsistent:
    return "Inconsistent";
  case vpReferenceStatus::NoImage:
    return "NoImage";
  }
  return "unknown";
}

class vpReferencePose::Impl
{
public:
  Impl(const std::vector<Eigen::Vector2d> &reference, double sigma, const vpReferencePoseSpec &spec)
    : m_spec(checked(spec)), m_reference(checked(reference, sigma, spec)), m_hypotheses(m_reference, sigma, m_spec)
  {
    reset();
  }

  void reset()
  {
    m_hypotheses.clear();
    m_failures = m_images = 0;
    m_seen.assign(m_reference.size(), 0);
    m_result = vpReferencePoseResult();
    m_result.scale = m_result.distance = 1. / m_hypotheses.prior().alpha;
  }

  void add(const std::vector<vpServoPoint> &points, double sigma, const vpRigidTransform *fMc)
  {
    take(points, sigma);
    const bool known = fMc && fMc->R.allFinite() && fMc->p.allFinite();
    if (m_view.count < m_spec.minPoints) {
      fail(vpReferenceStatus::TooFewPoints, "The image shows %zu points of the reference, at least %u are needed.",
           m_view.count, m_spec.minPoints);
      return;
    }
    if (!known && m_hypotheses.hasOdometry()) {
      fail(vpReferenceStatus::NoOdometry, "The pose of the camera at capture is not known; the image is not used.");
      return;
    }
    m_view.fMc = known ? *fMc : vpRigidTransform();
    if (!m_hypotheses.add(m_view, known)) {
      if (++m_failures >= mostFailures) {
        m_hypotheses.clear();
        m_failures = 0;
      }
      fail(vpReferenceStatus::Inconsistent, "No motion of the camera before a plane explains the image.");
      return;
    }
    m_failures = 0;
    std::transform(m_seen.begin(), m_seen.end(), m_view.visible.begin(), m_seen.begin(), std::plus<>());
    conclude();
  }

  void setNormalPrior(const Eigen::Vector3d &normal, double sigma)
  {
    vpCheckField("sigma", "the normal prior", sigma, "rad", vpFieldRange::positive());
    if (!(normal.allFinite() && normal.norm() > 0.)) {
      throw vpException(vpException::badValue, "the normal prior is (%g, %g, %g), must be finite and not zero",
                        normal.x(), normal.y(), normal.z());
    }
    m_hypotheses.setNormalPrior(normal.normalized(), sigma);
    reset();
  }

  [[nodiscard]] vpServoTarget target() const;
  void sight(double time, vpServoSight &sight) const;

  vpReferencePoseResult m_result;

private:
  static constexpr int mostFailures = 3; // images in succession
  // While the scale is too small, a law turns faster than it moves, and the object leaves the view; a little motion
  // tells it.
  static constexpr double slowStart = 0.1; // factor on the speed per image, until d is known
  static constexpr double largeTurn = 0.3; // rad, of the camera between two planes: full slowness

  static const vpReferencePoseSpec &checked(const vpReferencePoseSpec &spec)
  {
    spec.validate();
    return spec;
  }
  static const std::vector<Eigen::Vector2d> &checked(const std::vector<Eigen::Vector2d> &reference, double sigma,
                                                     const vpReferencePoseSpec &spec)
  {
    vpCheckField("sigma", "the reference points", sigma, "", vpFieldRange::positive());
    if (reference.size() < spec.minPoints) {
      throw vpException(vpException::badValue, "the reference has %zu points, at least %u are needed", reference.size(),
                        spec.minPoints);
    }
    for (std::size_t i = 0; i < reference.size(); ++i) {
      if (!reference[i].allFinite()) {
        throw vpException(vpException::badValue, "reference point %zu is (%g, %g), must be finite", i, reference[i].x(),
                          reference[i].y());
      }
    }
    return reference;
  }

  void take(const std::vector<vpServoPoint> &points, double sigma)
  {
    vpCheckField("sigma", "the image points", sigma, "", vpFieldRange::positive());
    if (points.size() != m_reference.size()) {
      throw vpException(vpException::badValue, "the image has %zu points, the reference has %zu", points.size(),
                        m_reference.size());
    }
    m_view.points.resize(points.size());
    m_view.visible.resize(points.size());
    m_view.count = 0;
    m_view.weight = 1. / (sigma * sigma);
    for (std::size_t i = 0; i < points.size(); ++i) {
      m_view.points[i] = {points[i].x, points[i].y};
      m_view.visible[i] = points[i].visible && m_view.points[i].allFinite();
      m_view.count += m_view.visible[i] ? 1 : 0;
    }
  }

  template <class... Numbers> void fail(vpReferenceStatus status, const char *format, Numbers... numbers)
  {
    m_result.status = status;
    say(format, numbers...);
  }
  template <class... Numbers> void say(const char *format, Numbers... numbers)
  {
    if constexpr (sizeof...(numbers) == 0) {
      m_result.message = format;
    }
    else {
      char text[240];
      std::snprintf(text, sizeof(text), format, numbers...);
      m_result.message = text;
    }
  }

  void conclude();
  void describe();
  [[nodiscard]] std::vector<Eigen::Vector2d> usedPoints() const;
  [[nodiscard]] Eigen::Vector3d onPlane(const Eigen::Vector2d &p) const;
  [[nodiscard]] Eigen::Vector3d origin() const;

  vpReferencePoseSpec m_spec;
  std::vector<Eigen::Vector2d> m_reference;
  vpReferenceHypotheses m_hypotheses;
  vpReferenceView m_view;
  std::vector<unsigned int> m_seen; // number of images that showed a point
  int m_failures = 0;
  int m_images = 0;
};

void vpReferencePose::Impl::conclude()
{
  const vpReferenceHypothesis &h = m_hypotheses.best();
  vpReferencePoseResult &r = m_result;
  r.R = h.R;
  r.tau = h.tau;
  r.normal = h.normal;
  r.hypotheses = m_hypotheses.count();
  r.images = m_hypotheses.images();
  r.misfit = m_hypotheses.misfit();
  const double sigma = std::sqrt(m_hypotheses.alphaVariance());
  const double low = 1. / m_spec.farthest, high = 1. / m_spec.nearest;
  const double alpha = std::clamp(h.alpha, low, high);
  r.distance = 1. / alpha;
  r.distanceSigma = sigma / (alpha * alpha);
  const double caution =
      m_hypotheses.hasOdometry() ? m_spec.caution : 0.; // without it the estimate is the range's middle
  r.scale = 1. / std::clamp(h.alpha + caution * sigma, low, high);
  Eigen::Map<Eigen::Matrix<double, 6, 6>>(r.covariance.data()) = h.covariance.topLeftCorner<6, 6>();
  r.status = m_hypotheses.onlyTurned() ? vpReferenceStatus::PureRotation
             : r.hypotheses > 1        ? vpReferenceStatus::Ambiguous
                                       : vpReferenceStatus::Unique;
  const bool isKnown = r.distanceSigma < 0.1 * r.distance;
  r.speedFactor = std::min(1. - (1. - m_spec.slowness) * std::min(m_hypotheses.disagreement() / largeTurn, 1.),
                           isKnown ? 1. : ++m_images * slowStart);
  describe();
}

void vpReferencePose::Impl::describe()
{
  vpReferencePoseResult &r = m_result;
  if (!m_hypotheses.hasOdometry()) {
    say("The reference plane is %.3g to %.3g m away as stated; without the robot's motion nothing more is known.",
        m_spec.nearest, m_spec.farthest);
  }
  else if (r.status == vpReferenceStatus::PureRotation) {
    say("The camera has only turned: the plane's distance is not known yet, %.3g to %.3g m.", m_spec.nearest,
        m_spec.farthest);
  }
  else if (r.status == vpReferenceStatus::Ambiguous) {
    say("%u planes explain the images so far; the likeliest is %.3g m away, standard deviation %.2g m.", r.hypotheses,
        r.distance, r.distanceSigma);
  }
  else {
    say("The reference plane is %.4g m away, standard deviation %.2g m.", r.distance, r.distanceSigma);
  }
}

std::vector<Eigen::Vector2d> vpReferencePose::Impl::usedPoints() const
{
  const unsigned int most = *std::max_element(m_seen.begin(), m_seen.end());
  std::vector<Eigen::Vector2d> used;
  for (std::size_t i = 0; i < m_reference.size(); ++i) {
    if (2 * m_seen[i] >= most) {
      used.push_back(m_reference[i]);
    }
  }
  return used;
}

Eigen::Vector3d vpReferencePose::Impl::onPlane(const Eigen::Vector2d &p) const
{
  const Eigen::Vector3d m = p.homogeneous();
  return m_result.scale / m_result.normal.dot(m) * m;
}

Eigen::Vector3d vpReferencePose::Impl::origin() const
{
  const std::vector<Eigen::Vector2d> used = usedPoints();
  const Eigen::Vector2d sum = std::accumulate(used.begin(), used.end(), Eigen::Vector2d(0., 0.));
  return onPlane(sum / static_cast<double>(used.size()));
}

vpServoTarget vpReferencePose::Impl::target() const
{
  const Eigen::Vector3d centre = origin();
  Eigen::AlignedBox2d box;
  std::vector<Eigen::Vector3d> points, outline;
  for (const Eigen::Vector2d &p : usedPoints()) {
    points.push_back(onPlane(p) - centre);
    box.extend(p);
  }
  for (const auto corner : {box.BottomLeft, box.BottomRight, box.TopRight, box.TopLeft}) { // y is down
    outline.push_back(onPlane(box.corner(corner)) - centre);
  }
  return vpServoTarget(std::move(points), std::move(outline));
}

void vpReferencePose::Impl::sight(double time, vpServoSight &sight) const
{
  const vpReferencePoseResult &r = m_result;
  sight.measurement.time = time;
  sight.measurement.valid = sight.hasGoal = r.found();
  sight.distance = r.distance;
  sight.distanceSigma = r.distanceSigma;
  sight.speedFactor = r.speedFactor;
  if (!r.found()) {
    return;
  }
  const Eigen::Vector3d centre = origin(), t = r.R.transpose() * (centre - r.scale * r.tau);
  const vpServoTarget object = target();
  sight.goal = object.goal(vpRigidTransform{Eigen::Matrix3d::Identity(), centre}.toHomogeneous());
  object.measure(vpRigidTransform{r.R.transpose(), t}.toHomogeneous(), time, sight.measurement);
  // An error (a, e) of tau and R moves the object by t x e - d R^T a and turns it by -e.
  Eigen::Matrix<double, 6, 6> J = Eigen::Matrix<double, 6, 6>::Zero();
  J.topLeftCorner<3, 3>() = -r.scale * r.R.transpose();
  J.topRightCorner<3, 3>() = vpSO3::skew(t);
  J.bottomRightCorner<3, 3>() = -Eigen::Matrix3d::Identity();
  vpPoseCovariance &covariance = sight.measurement.covariance;
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(covariance.C.data()) =
      J * Eigen::Map<const Eigen::Matrix<double, 6, 6>>(r.covariance.data()) * J.transpose();
  covariance.known = true;
}

vpReferencePose::vpReferencePose(const std::vector<Eigen::Vector2d> &reference, double sigma,
                                 const vpReferencePoseSpec &spec)
  : m_impl(std::make_unique<Impl>(reference, sigma, spec))
{}

vpReferencePose::~vpReferencePose() = default;
vpReferencePose::vpReferencePose(vpReferencePose &&) noexcept = default;
vpReferencePose &vpReferencePose::operator=(vpReferencePose &&) noexcept = default;

const vpReferencePoseResult &vpReferencePose::add(const std::vector<vpServoPoint> &points, double sigma,
                                                  const vpRigidTransform *fMc)
{
  m_impl->add(points, sigma, fMc);
  return m_impl->m_result;
}

void vpReferencePose::setNormalPrior(const Eigen::Vector3d &normal, double sigma)
{
  m_impl->setNormalPrior(normal, sigma);
}

void vpReferencePose::reset() { m_impl->reset(); }

const vpReferencePoseResult &vpReferencePose::result() const { return m_impl->m_result; }

vpServoTarget vpReferencePose::target() const { return m_impl->target(); }

void vpReferencePose::sight(double time, vpServoSight &sight) const { m_impl->sight(time, sight); }

END_VISP_NAMESPACE
