/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPlanarTargetImpl.h"

#include "vpKeypoints.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpPixelMeterConversion.h>
#include <visp3/direct_core/vpSO3.h>

#include <Eigen/LU>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double smallestTarget = 1e-6, largestTarget = 1e6; // m
constexpr double mostAspect = 10.;                           // of a pixel of the reference
constexpr double smallestContrast = 4.;                      // standard deviation of the reference, grey levels
constexpr int keypointReferenceSize =
    400; // px; a larger reference is reduced so that its keypoints have a frame's scale
constexpr std::size_t tellingCount = 128;   // keypoints that show whether a target may be visible
constexpr int mostRefinements = 3;          // of a start of an acquisition, if it converges slowly
constexpr double keypointReach = 2.;        // px; error of a pose from keypoints
constexpr double motionReach = 14.;         // px; error of a pose from the previous frame
constexpr double rivalReach = 6.;           // px; error of the mirrored pose
constexpr double largestTurn = 0.35;        // rad between frames; more is out of reach, and means another optimum
constexpr double smallestFrontality = 0.17; // 80 deg from the normal
constexpr double smallestInImage = 0.25;    // share of the target
constexpr double smallestUnhidden = 0.4;    // share of the part in the image; half is the limit of robust estimation

template <typename... Args> std::string message(const char *format, Args... args)
{
  char text[256];
  std::snprintf(text, sizeof(text), format, args...);
  return text;
}

vpPoseCovariance covarianceOf(const vpPixelFit &fit)
{
  vpPoseCovariance covariance;
  covariance.known = true;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      covariance(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) = fit.covariance(i, j);
    }
  }
  return covariance;
}

double pixelAspect(const vpCameraParameters &camera) { return camera.get_px() / camera.get_py(); }

// The reference with square pixels, reduced where it is large.
cv::Mat keypointImage(const cv::Mat &image, double width, double height)
{
  const double scale = std::min(1., static_cast<double>(keypointReferenceSize) / std::max(image.cols, image.rows));
  const double aspect = (image.cols / width) / (image.rows / height);
  const double stretch = std::abs(aspect - 1.) < 0.02 ? 1. : std::sqrt(aspect);
  cv::Mat reduced = image;
  if (scale < 1. || stretch != 1.) {
    cv::resize(image, reduced, cv::Size(), scale / stretch, scale * stretch, cv::INTER_AREA);
  }
  return reduced;
}

vpTargetPlane makePlane(const vpImage<unsigned char> &reference, double width, double height)
{
  if (reference.getWidth() < smallestImage || reference.getHeight() < smallestImage) {
    throw vpException(vpException::dimensionError, "reference image is %ux%u px, must be at least %ux%u",
                      reference.getWidth(), reference.getHeight(), smallestImage, smallestImage);
  }
  const auto plausible = [](double size) { return size >= smallestTarget && size <= largestTarget; };
  if (!plausible(width) || !plausible(height)) {
    throw vpException(vpException::badValue, "size of the target is %g x %g m, must be > 0, from %g to %g", width,
                      height, smallestTarget, largestTarget);
  }
  const double aspect = width / reference.getWidth() / (height / reference.getHeight());
  if (!(aspect >= 1. / mostAspect && aspect <= mostAspect)) {
    throw vpException(
        vpException::badValue,
        "target of %g x %g m has an image of %u x %u px, whose pixels are %g times as wide as high, must be "
        "from %g to %g times",
        width, height, reference.getWidth(), reference.getHeight(), aspect, 1. / mostAspect, mostAspect);
  }
  return {width, height, static_cast<int>(reference.getWidth()), static_cast<int>(reference.getHeight())};
}
} // namespace

vpPlanarTarget::Impl::Impl(const vpImage<unsigned char> &reference, double width, double height,
                           const vpCameraParameters &camera, const vpPlanarTargetSpec &spec)
  : m_spec(spec), m_viewer(camera), m_camera(vpPinhole::fromCamera(camera)),
    m_plane(makePlane(reference, width, height)), m_ownFrame(spec, pixelAspect(camera))
{
  spec.validate();
  const cv::Mat image = pixelsOf(reference);
  m_model = std::make_unique<vpPhotometricModel>(image, m_plane, static_cast<int>(spec.refinementSize));
  if (m_model->contrast() < smallestContrast) {
    throw vpException(vpException::badValue,
                      "reference image is blank: its grey values deviate by %.1f from their mean, must be at "
                      "least %.0f",
                      m_model->contrast(), smallestContrast);
  }
  m_refiner = std::make_unique<vpPhotometricRefiner>(*m_model, m_plane, m_camera, !spec.exact);
  if (spec.refine) {
    m_texture = std::make_unique<vpTargetTexture>(image, m_plane);
    m_choice = std::make_unique<vpPoseChoice>(*m_texture, m_plane, m_camera);
  }

  const cv::Mat reduced = keypointImage(image, width, height);
  const vpTargetPlane reducedPlane{width, height, reduced.cols, reduced.rows};
  std::vector<vpKeypointType> types{spec.keypoints};
  if (spec.fallback && spec.keypoints != vpKeypointType::AKAZE) {
    types.push_back(vpKeypointType::AKAZE);
  }
  unsigned int most = 0;
  for (vpKeypointType type : types) {
    Reference r{type, {}, {}, {}};
    makeKeypointExtractor(type, spec)->extract(reduced, r.keypoints);
    r.telling = tellingKeypoints(r.keypoints, tellingCount);
    for (const cv::Point2f &p : r.keypoints.points) {
      r.plane.push_back(reducedPlane.metric(p.x, p.y));
    }
    most = std::max(most, static_cast<unsigned int>(r.plane.size()));
    m_references.push_back(std::move(r));
  }
  if (most < spec.minInliers) {
    throw vpException(vpException::badValue,
                      "reference image has too little texture: %u %s keypoints, at least %u are needed", most,
                      vpToString(types.front()), spec.minInliers);
  }
}

bool vpPlanarTarget::Impl::refuse(const vpImage<unsigned char> &image)
{
  if (image.getWidth() >= smallestImage && image.getHeight() >= smallestImage) {
    return false;
  }
  fail(vpPlanarTargetStatus::NoTexture, message("The image is %ux%u px, at least %ux%u are needed.", image.getWidth(),
                                                image.getHeight(), smallestImage, smallestImage));
  return true;
}

void vpPlanarTarget::Impl::fail(vpPlanarTargetStatus status, const std::string &message)
{
  vpPlanarTargetResult failed;
  failed.status = status;
  failed.message = message;
  failed.inliers = m_result.inliers;
  failed.correlation = m_result.correlation;
  failed.visible = m_result.visible;
  reset();
  m_result = failed;
}

void vpPlanarTarget::Impl::reset()
{
  m_known = m_decided = false;
  m_result = vpPlanarTargetResult();
  if (m_choice) {
    m_choice->forget();
  }
}

void vpPlanarTarget::Impl::process(vpTargetFrame &frame)
{
  if (m_fresh) { // the first image may be the only one
    acquire(frame);
    return;
  }
  m_search.process(frame, {this});
}

std::size_t vpPlanarTarget::Impl::matchesOf(const vpKeypointSet &part, const vpKeypointSet &current)
{
  return matchKeypoints(part, current).size();
}

void vpPlanarTarget::Impl::acquire(vpTargetFrame &frame)
{
  reset();
  m_fresh = false;
  for (const Reference &reference : m_references) {
    const vpPlanarTargetResult before = m_result;
    acquireWith(reference, frame.keypoints(reference.type), frame);
    if (m_known) {
      return;
    }
    // Report the detector that got furthest.
    if (before.inliers > m_result.inliers) {
      m_result = before;
    }
  }
}

void vpPlanarTarget::Impl::acquireWith(const Reference &reference, const vpKeypointSet &current,
                                       const vpTargetFrame &frame)
{
  m_result = vpPlanarTargetResult();
  if (current.points.size() < m_spec.minInliers) {
    fail(vpPlanarTargetStatus::NoTexture,
         message("The image has %zu %s keypoints, at least %u are needed.", current.points.size(),
                 vpToString(reference.type), m_spec.minInliers));
    return;
  }
  vpPlaneMatches matches;
  for (const auto &pair : matchKeypoints(reference.keypoints, current)) {
    const cv::Point2f &p = current.points[static_cast<std::size_t>(pair.second)];
    Eigen::Vector2d x;
    vpPixelMeterConversion::convertPoint(m_viewer, p.x, p.y, x.x(), x.y());
    matches.plane.push_back(reference.plane[static_cast<std::size_t>(pair.first)]);
    matches.image.push_back(x);
  }
  const double pixels = std::sqrt(m_camera.px * m_camera.py);
  const vpPlanePoses poses =
      planePoses(matches, m_plane.cols / m_plane.width, pixels, m_spec.inlierThreshold, m_spec.minInliers);
  m_result.inliers = static_cast<unsigned int>(poses.inliers.size());
  if (m_result.inliers < m_spec.minInliers) {
    fail(vpPlanarTargetStatus::TooFewInliers,
         message("%u of %zu %s matches agree on one plane, at least %u must.", m_result.inliers, matches.plane.size(),
                 vpToString(reference.type), m_spec.minInliers));
    return;
  }
  if (!checkView(poses.best)) {
    return;
  }
  if (!m_spec.refine) {
    finish(frame, poses.best, {}, vpPlanarTargetStatus::Acquired);
    return;
  }
  std::vector<Candidate> candidates = {refineStart(frame, poses.best, matches, poses.inliers)};
  if (poses.rival) {
    candidates.push_back(refineStart(frame, *poses.rival, matches, poses.inliers));
    if (candidates[1].correlation > candidates[0].correlation) {
      std::swap(candidates[0], candidates[1]);
    }
  }
  acquireFrom(frame, candidates);
}

// One whose refinement has not converged is tried, too: it may be the right one, and the other converged elsewhere.
void vpPlanarTarget::Impl::acquireFrom(const vpTargetFrame &frame, const std::vector<Candidate> &candidates)
{
  if (!candidates[0].agrees) {
    fail(vpPlanarTargetStatus::LowCorrelation,
         message("%u keypoints agree on a pose that the grey values do not confirm.", m_result.inliers));
    return;
  }
  for (const Candidate &candidate : candidates) {
    if (candidate.agrees) {
      m_refiner->verify(frame.pyramid(), candidate.pose); // gain and bias
      const vpPoseDecision decision = decide(frame, candidate.pose);
      if (decision.best.converged) {
        finish(frame, candidate.pose, decision, vpPlanarTargetStatus::Acquired);
        return;
      }
    }
  }
  if (m_spec.exact && candidates[0].converged) {
    finish(frame, candidates[0].pose, {}, vpPlanarTargetStatus::Acquired); // of unknown error
    return;
  }
  fail(vpPlanarTargetStatus::LowCorrelation,
       message("The refinement of a pose on which %u keypoints agree did not converge.", m_result.inliers));
}

// Two independent checks: a refinement that leaves the keypoints has found something else.
vpPlanarTarget::Impl::Candidate vpPlanarTarget::Impl::refineStart(const vpTargetFrame &frame, const vpRigidPose &start,
                                                                  const vpPlaneMatches &matches,
                                                                  const std::vector<std::size_t> &inliers)
{
  const double pixels = std::sqrt(m_camera.px * m_camera.py);
  Candidate c;
  c.pose = start;
  const auto agrees = [&] {
    return c.pose.isFinite() && nearestCornerDepth(m_plane, c.pose) > 0. &&
           pixels * medianError(matches, inliers, c.pose) < 2. * m_spec.inlierThreshold;
  };
  // Of a target partly in view the tilt converges slowly; the steps continue at the finest level.
  double reach = keypointReach;
  for (int k = 0; k < mostRefinements && !c.converged && agrees(); ++k, reach = 0.) {
    c.converged = m_refiner->refine(frame.pyramid(), c.pose, reach, m_spec.maxIterations);
  }
  c.agrees = agrees();
  c.correlation = c.agrees ? m_refiner->verify(frame.pyramid(), c.pose).correlation : 0.;
  return c;
}

void vpPlanarTarget::Impl::trackLast(vpTargetFrame &frame)
{
  if (m_known) {
    track(frame, vpRigidPose::fromMatrix(m_result.cMo));
  }
  else {
    m_result = vpPlanarTargetResult();
    fail(vpPlanarTargetStatus::LowCorrelation, "There is no earlier pose to track from.");
  }
}

void vpPlanarTarget::Impl::track(vpTargetFrame &frame, const vpRigidPose &guess)
{
  m_result = vpPlanarTargetResult();
  if (!guess.isFinite()) {
    fail(vpPlanarTargetStatus::OutOfView, "The pose to track from is not finite.");
    return;
  }
  if (!(guess.R.transpose() * guess.R).isIdentity(1e-3) || guess.R.determinant() < 0.) {
    fail(vpPlanarTargetStatus::OutOfView, "The pose to track from has no rotation matrix.");
    return;
  }
  if (!checkView(guess)) {
    return;
  }
  // Small motion is the usual case, and the fine levels alone tolerate more occlusion; the coarse ones reach further.
  if (!trackFrom(frame, guess, keypointReach)) {
    m_result = vpPlanarTargetResult();
    trackFrom(frame, guess, motionReach);
  }
}

bool vpPlanarTarget::Impl::trackFrom(const vpTargetFrame &frame, const vpRigidPose &guess, double reach)
{
  vpRigidPose pose = guess;
  if (!m_refiner->refine(frame.pyramid(), pose, reach, m_spec.maxIterations)) {
    fail(vpPlanarTargetStatus::LowCorrelation,
         "The refinement did not converge: the grey values do not lead to the target.");
    return false;
  }
  const double turn = vpSO3::log(pose.R * guess.R.transpose()).norm();
  if (turn > largestTurn) {
    fail(vpPlanarTargetStatus::LowCorrelation,
         message("The target would have turned by %.0f deg in one frame, at most %.0f deg can be tracked.",
                 turn * 180. / M_PI, largestTurn * 180. / M_PI));
    return false;
  }
  if (usesLastStage() && !m_choice->follows(pose)) {
    preferRival(frame, pose, reach);
  }
  return conclude(frame, pose, vpPlanarTargetStatus::Tracked);
}

// A hint may be the mirrored pose. Where perspective is strong, that is a false optimum from which the last stage,
// whose reach is one pixel, does not find the other one.
void vpPlanarTarget::Impl::preferRival(const vpTargetFrame &frame, vpRigidPose &pose, double reach)
{
  vpRigidPose rival = rivalPose(pose, seenCentre(m_plane, pose, m_camera, frame.image().cols, frame.image().rows));
  const double correlation = m_refiner->verify(frame.pyramid(), pose).correlation;
  if (nearestCornerDepth(m_plane, rival) > 0. &&
      m_refiner->refine(frame.pyramid(), rival, std::max(reach, rivalReach), m_spec.maxIterations) &&
      m_refiner->verify(frame.pyramid(), rival).correlation > correlation) {
    pose = rival;
  }
}

// The plane must be in front of the camera and face it.
bool vpPlanarTarget::Impl::checkView(const vpRigidPose &pose)
{
  const double depth = nearestCornerDepth(m_plane, pose), facing = frontality(pose);
  if (!(depth > 0.)) {
    fail(vpPlanarTargetStatus::OutOfView,
         message("A corner of the target is at depth %.3g m, behind the camera.", depth));
    return false;
  }
  if (!(facing > smallestFrontality)) {
    fail(vpPlanarTargetStatus::OutOfView,
         message("The target is seen at %.0f deg from its normal, at most %.0f deg can be used.",
                 std::acos(facing) * 180. / M_PI, std::acos(smallestFrontality) * 180. / M_PI));
    return false;
  }
  return true;
}

vpPoseDecision vpPlanarTarget::Impl::decide(const vpTargetFrame &frame, const vpRigidPose &coarse)
{
  return m_choice->decide(frame.image(), coarse, {m_refiner->gain(), m_refiner->bias(), m_blur});
}

bool vpPlanarTarget::Impl::conclude(const vpTargetFrame &frame, const vpRigidPose &coarse, vpPlanarTargetStatus success)
{
  if (!coarse.isFinite() || !checkView(coarse)) {
    return false;
  }
  return finish(frame, coarse, usesLastStage() ? decide(frame, coarse) : vpPoseDecision(), success);
}

// Only a pose confirmed by the grey values becomes a result.
bool vpPlanarTarget::Impl::finish(const vpTargetFrame &frame, const vpRigidPose &coarse, const vpPoseDecision &decision,
                                  vpPlanarTargetStatus success)
{
  if (decision.doubtful) {
    fail(vpPlanarTargetStatus::LowCorrelation,
         "The pose fits badly, and the grey values do not decide between it and the mirrored one.");
    return false;
  }
  if (m_choice && !m_spec.exact && !m_decided && !decision.best.converged) {
    fail(vpPlanarTargetStatus::LowCorrelation,
         "The last stage, which decides between the two poses of the plane, did not converge.");
    return false;
  }
  // Without convergence, for example with few pixels, there is a pose, but its error is unknown.
  const vpRigidPose pose = decision.best.converged ? decision.best.pose : coarse;
  if (!checkView(pose) || !confirm(frame, pose)) {
    return false;
  }
  m_decided = decision.certain;
  report(pose, decision, decision.certain ? success : vpPlanarTargetStatus::Ambiguous);
  return true;
}

bool vpPlanarTarget::Impl::confirm(const vpTargetFrame &frame, const vpRigidPose &pose)
{
  const vpPhotometricFit fit = m_refiner->verify(frame.pyramid(), pose);
  m_result.correlation = fit.correlation;
  m_result.visible = fit.visible;
  if (fit.inImage < smallestInImage) {
    fail(vpPlanarTargetStatus::OutOfView, message("%.0f %% of the target is in the image, at least %.0f %% must be.",
                                                  100. * fit.inImage, 100. * smallestInImage));
    return false;
  }
  if (fit.visible < smallestUnhidden * fit.inImage) {
    fail(vpPlanarTargetStatus::LowCorrelation,
         message("%.0f %% of the target in the image fits the reference, at least %.0f %% must.",
                 100. * fit.visible / fit.inImage, 100. * smallestUnhidden));
    return false;
  }
  if (!(fit.correlation >= m_spec.minCorrelation)) {
    fail(vpPlanarTargetStatus::LowCorrelation, message("Correlation with the reference is %.2f, must be at least %.2f.",
                                                       fit.correlation, m_spec.minCorrelation));
    return false;
  }
  return true;
}

void vpPlanarTarget::Impl::report(const vpRigidPose &pose, const vpPoseDecision &decision, vpPlanarTargetStatus success)
{
  m_known = true;
  m_result.status = success;
  pose.copyTo(m_result.cMo);
  const Eigen::Matrix3d H = m_plane.homography(pose, m_camera);
  for (int i = 0; i < 9; ++i) {
    m_result.homography[static_cast<std::size_t>(i)] = H(i / 3, i % 3);
  }
  const auto corners = m_plane.corners();
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d P = pose.R.leftCols<2>() * corners[i] + pose.t;
    const Eigen::Vector2d p = m_camera.project(P.head<2>() / P.z());
    m_result.corners[i].set_uv(p.x(), p.y());
  }
  if (decision.best.converged) {
    m_result.covariance = covarianceOf(decision.best);
    m_result.residual = decision.best.residual;
    m_result.greySigma = decision.best.sigma;
    m_result.kappa = decision.best.kappa;
    m_result.hidden = decision.best.hidden;
    m_result.blur = m_blur = decision.best.camera.blur;
    m_result.evidence = decision.evidence;
  }
  if (decision.rival) {
    vpPlanarTargetRival &rival = m_result.rival.emplace();
    decision.rival->pose.copyTo(rival.cMo);
    rival.residual = decision.rival->residual;
    rival.covariance = covarianceOf(*decision.rival);
  }
  switch (success) {
  case vpPlanarTargetStatus::Acquired:
    m_result.message = message("Acquired with %u inliers, correlation %.2f, %.0f %% visible.", m_result.inliers,
                               m_result.correlation, 100. * m_result.visible);
    break;
  case vpPlanarTargetStatus::Ambiguous:
    m_result.message = message("Two poses %.1f deg apart fit, residuals %.2f and %.2f: the odds are e^%.1f, e^9.2 and "
                               "3 deviations decide.",
                               vpSO3::log(pose.R * decision.rival->pose.R.transpose()).norm() * 180. / M_PI,
                               m_result.residual, m_result.rival->residual, m_result.evidence);
    break;
  default:
    m_result.message =
        message("Tracked, correlation %.2f, %.0f %% visible.", m_result.correlation, 100. * m_result.visible);
  }
}

END_VISP_NAMESPACE
