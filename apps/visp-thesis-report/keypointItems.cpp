/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Chapter 4: keypoints of a real photograph in rendered views.
#include "keypointItems.h"

#include "dataFile.h"

#include <visp3/core/vpThetaUVector.h>
#include <visp3/io/vpImageIo.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace thesisReport
{
namespace
{
constexpr unsigned int WIDTH = 640, HEIGHT = 480;  // px
constexpr double FOCAL_LENGTH = 800.;              // px
constexpr double TARGET_WIDTH = 0.2;               // m
constexpr double CLUTTER_WIDTH = 0.9, BEHIND = 1.; // m: fills the view

vpImage<unsigned char> photo(const std::string &name)
{
  vpImage<unsigned char> image;
  vpImageIo::read(image, vpApp::dataFile("target/" + name));
  return image;
}

double heightOf(const vpImage<unsigned char> &image, double width)
{
  return width * image.getHeight() / image.getWidth();
}

vpPlaneRenderer clutter()
{
  const vpImage<unsigned char> image = photo("starry-night.jpg");
  return {image, CLUTTER_WIDTH, heightOf(image, CLUTTER_WIDTH), keypointCamera(), WIDTH, HEIGHT};
}

constexpr double DISTANCE = 0.4;        // m: the photograph is 400 px wide
constexpr unsigned int KEYPOINTS = 244; // second column of table 4.2
constexpr int VIEWS = 24;
constexpr int REFINED_VIEWS = 8; // of these, also with vpPlanarTarget
constexpr double NOISE = 6., BLUR = 1., HIDDEN = 0.1;
constexpr double WRONG_FOCAL_LENGTH = 1.01;
constexpr double UNIT = 1e-3;  // relative to the distance
constexpr double NEVER = 1e-9; // disables limits of the decomposition, which the thesis does not have

vpHomogeneousMatrix poseAt(PoseAxis axis, double offset)
{
  const double angle = offset * M_PI / 180., step = offset * UNIT * DISTANCE;
  switch (axis) {
  case PoseAxis::Roll:
    return poseOf(0., 0., DISTANCE, angle, 0., 0.);
  case PoseAxis::Pitch:
    return poseOf(0., 0., DISTANCE, 0., angle, 0.);
  case PoseAxis::Yaw:
    return poseOf(0., 0., DISTANCE, 0., 0., angle);
  case PoseAxis::X:
    return poseOf(step, 0., DISTANCE, 0., 0., 0.);
  case PoseAxis::Y:
    return poseOf(0., step, DISTANCE, 0., 0., 0.);
  case PoseAxis::Z:
    break;
  }
  return poseOf(0., 0., DISTANCE + step, 0., 0., 0.);
}

//! Component of a motion along or about the axis. \param t : Relative to the distance of the plane.
double componentOf(const vpRotationMatrix &R, const vpTranslationVector &t, PoseAxis axis)
{
  const vpThetaUVector rotation(R);
  switch (axis) {
  case PoseAxis::Roll:
    return rotation[2] * 180. / M_PI;
  case PoseAxis::Pitch:
    return rotation[0] * 180. / M_PI;
  case PoseAxis::Yaw:
    return rotation[1] * 180. / M_PI;
  case PoseAxis::X:
    return t[0] / UNIT;
  case PoseAxis::Y:
    return t[1] / UNIT;
  case PoseAxis::Z:
    break;
  }
  return t[2] / UNIT;
}

vpCameraFaults faults(unsigned int view, double hidden)
{
  vpCameraFaults f;
  f.noise = NOISE;
  f.blur = BLUR;
  f.occlusion = hidden;
  f.occluder = view;
  return f;
}
vpTwoViewResult motionOf(const vpPlaneMatch &match, const vpCameraParameters &camera)
{
  vpTwoViewSpec spec;
  spec.minTranslation = spec.normalTolerance = NEVER;
  vpTwoViewDecomposition decomposition(spec);
  vpColVector ahead(3);
  ahead[2] = 1.;
  decomposition.setNormalPrior(ahead);
  return decomposition.process(match.euclidean(camera), match.referencePoints(camera));
}
} // namespace

std::vector<Part> keypointParts()
{
  const std::string chapter = "Chapter 4: 3D vision";
  return {{chapter, {{"table4.2", "SIFT and SURF: keypoints, matches and time"}}, 28., keypointTable},
          {chapter, {{"table4.3", "accuracy of the homography's decomposition with SURF"}}, 65., poseTable}};
}

vpCameraParameters keypointCamera() { return {FOCAL_LENGTH, FOCAL_LENGTH, 0.5 * (WIDTH - 1.), 0.5 * (HEIGHT - 1.)}; }

vpHomogeneousMatrix poseOf(double x, double y, double z, double roll, double pitch, double yaw)
{
  const vpHomogeneousMatrix Rx(0., 0., 0., pitch, 0., 0.), Ry(0., 0., 0., 0., yaw, 0.), Rz(0., 0., 0., 0., 0., roll);
  return vpHomogeneousMatrix(x, y, z, 0., 0., 0.) * Ry * Rx * Rz;
}

vpPlaneMatcher matcherWith(const vpImage<unsigned char> &reference, vpKeypointType type, unsigned int keypoints)
{
  vpPlanarTargetSpec spec;
  spec.keypoints = type;
  spec.maxKeypoints = keypoints;
  vpPlaneMatcher matcher(reference, spec);
  for (int i = 0; i < 4; ++i) {
    const auto found = static_cast<double>(matcher.result().referenceKeypoints);
    if (found >= keypoints) {
      break;
    }
    const auto more = static_cast<unsigned int>(std::lround(spec.maxKeypoints + std::max(1., keypoints - found)));
    spec.maxKeypoints = more;
    vpPlaneMatcher next(reference, spec);
    if (next.result().referenceKeypoints == matcher.result().referenceKeypoints) {
      break; // no more keypoints
    }
    matcher = std::move(next);
  }
  return matcher;
}

vpPlaneMatcher surfMatcher(const vpImage<unsigned char> &reference, unsigned int keypoints, const SurfScales &scales)
{
  constexpr int halvings = 12;
  vpPlanarTargetSpec spec;
  spec.keypoints = vpKeypointType::SURF;
  spec.maxKeypoints = 10000; // the threshold decides
  spec.surfOctaves = scales.octaves;
  spec.surfLayers = scales.layers;
  spec.surfUpright = scales.upright;
  double low = 0., high = 1000.;
  for (int i = 0; i < halvings; ++i) {
    spec.surfThreshold = 0.5 * (low + high);
    bool more = false; // than wanted
    try {
      more = vpPlaneMatcher(reference, spec).result().referenceKeypoints >= keypoints;
    }
    catch (const vpException &) { // too few to match
    }
    (more ? low : high) = spec.surfThreshold;
  }
  spec.surfThreshold = low;
  return vpPlaneMatcher(reference, spec);
}

KeypointScene::KeypointScene()
  : m_photo(photo("klimt.jpg")), m_width(TARGET_WIDTH), m_height(heightOf(m_photo, TARGET_WIDTH)),
    m_target(m_photo, m_width, m_height, keypointCamera(), WIDTH, HEIGHT), m_background(clutter())
{}

void KeypointScene::renderAlone(const vpHomogeneousMatrix &cMo, const vpCameraFaults &faults, unsigned int seed,
                                vpImage<unsigned char> &image)
{
  m_target.render(cMo, faults, 2 * seed + 1, image);
}

void KeypointScene::render(const vpHomogeneousMatrix &cMo, const vpCameraFaults &faults, unsigned int seed,
                           vpImage<unsigned char> &image)
{
  vpCameraFaults behind = faults;
  behind.occlusion = 0.;
  vpImage<unsigned char> target;
  m_background.render(vpHomogeneousMatrix(0., 0., BEHIND, 0., 0., 0.), behind, 2 * seed, image);
  renderAlone(cMo, faults, seed, target);
  std::vector<cv::Point> corners;
  for (const auto &corner : {std::make_pair(-1., -1.), {1., -1.}, {1., 1.}, {-1., 1.}}) {
    const double X = 0.5 * m_width * corner.first, Y = 0.5 * m_height * corner.second;
    const double z = cMo[2][0] * X + cMo[2][1] * Y + cMo[2][3];
    const double x = (cMo[0][0] * X + cMo[0][1] * Y + cMo[0][3]) / z,
                 y = (cMo[1][0] * X + cMo[1][1] * Y + cMo[1][3]) / z;
    corners.emplace_back(static_cast<int>(std::lround(FOCAL_LENGTH * x + 0.5 * (WIDTH - 1.))),
                         static_cast<int>(std::lround(FOCAL_LENGTH * y + 0.5 * (HEIGHT - 1.))));
  }
  const auto view = [](vpImage<unsigned char> &of) { return cv::Mat(HEIGHT, WIDTH, CV_8UC1, of.bitmap); };
  cv::Mat mask(HEIGHT, WIDTH, CV_8UC1, cv::Scalar(0));
  cv::fillConvexPoly(mask, corners, cv::Scalar(255));
  view(target).copyTo(view(image), mask);
}

const char *nameOf(PoseAxis axis)
{
  static const char *const names[] = {"roll", "pitch", "yaw", "x", "y", "z"};
  return names[static_cast<std::size_t>(axis)];
}

bool isAngle(PoseAxis axis) { return axis == PoseAxis::Roll || axis == PoseAxis::Pitch || axis == PoseAxis::Yaw; }

std::string unitOf(PoseAxis axis) { return isAngle(axis) ? " deg" : ""; }

PoseExperiment::PoseExperiment(unsigned int seed) : m_seed(seed)
{
  vpImage<unsigned char> reference;
  m_scene.renderAlone(poseAt(PoseAxis::Roll, 0.), faults(0, 0.), m_seed * 10000, reference);
  m_matcher = std::make_unique<vpPlaneMatcher>(surfMatcher(reference, KEYPOINTS));
  m_target =
      std::make_unique<vpPlanarTarget>(m_scene.photograph(), m_scene.width(), m_scene.height(), keypointCamera());
}

void PoseExperiment::compare(const vpPlaneMatch &match, PoseAxis axis, double offset, PoseErrors &errors) const
{
  const vpCameraParameters camera = keypointCamera();
  const vpCameraParameters longer(WRONG_FOCAL_LENGTH * camera.get_px(), WRONG_FOCAL_LENGTH * camera.get_py(),
                                  camera.get_u0(), camera.get_v0());
  const vpTwoViewResult found = motionOf(match, camera), wrong = motionOf(match, longer);
  if (found.status != vpTwoViewStatus::Unique) {
    ++errors.lost;
    return;
  }
  errors.surf.add(componentOf(found.best.c2Rc1, found.best.t, axis) - offset);
  vpTranslationVector centre = found.best.t; // of a point straight ahead at distance 1
  for (unsigned int i = 0; i < 3; ++i) {
    centre[i] += found.best.c2Rc1[i][2] - (i == 2 ? 1. : 0.);
  }
  errors.centre.add(componentOf(found.best.c2Rc1, centre, axis) - offset);
  errors.matches.add(static_cast<double>(match.inliers.size()));
  if (wrong.status == vpTwoViewStatus::Unique) {
    errors.wrongLens.add(componentOf(wrong.best.c2Rc1, wrong.best.t, axis) - offset);
  }
}

void PoseExperiment::refine(const vpImage<unsigned char> &image, PoseAxis axis, double offset, PoseErrors &errors)
{
  if (!m_target->acquire(image).found()) {
    return;
  }
  const vpHomogeneousMatrix c2Mc1 = m_target->result().cMo * poseAt(axis, 0.).inverse();
  vpTranslationVector t = m_target->result().cMo.getTranslationVector(); // of the object's centre
  t[2] -= DISTANCE;
  for (unsigned int i = 0; i < 3; ++i) {
    t[i] /= DISTANCE;
  }
  errors.refined.add(componentOf(c2Mc1.getRotationMatrix(), t, axis) - offset);
}

PoseErrors PoseExperiment::run(PoseAxis axis, double offset, bool busy)
{
  PoseErrors errors;
  vpImage<unsigned char> image;
  for (int k = 0; k < VIEWS; ++k) {
    ++m_views;
    const unsigned int noise = m_seed * 10000 + m_views;
    if (busy) {
      m_scene.render(poseAt(axis, offset), faults(m_views, HIDDEN), noise, image);
    }
    else {
      m_scene.renderAlone(poseAt(axis, offset), faults(m_views, HIDDEN), noise, image);
    }
    const vpPlaneMatch &match = m_matcher->match(image);
    if (match.found()) {
      compare(match, axis, offset, errors);
    }
    else {
      ++errors.lost;
    }
    if (k < REFINED_VIEWS && !busy) {
      refine(image, axis, offset, errors);
    }
  }
  return errors;
}

std::vector<std::pair<std::string, std::string>> poseParameters()
{
  return {
      {"object", "data/target/klimt.jpg, 0.2 m wide, 0.4 m ahead of the camera, before the renderer's faint "
                 "background, or, where said, before data/target/starry-night.jpg"},
      {"camera", "640 x 480 px, focal length 800 px, known exactly"},
      {"keypoints",
       "SURF (dlib), 2 octaves of 2 scales, with the threshold that the reference passes with 244, as in the second "
       "column of table 4.2"},
      {"views",
       std::to_string(VIEWS) + " of each offset (" + std::to_string(REFINED_VIEWS) +
           " for vpPlanarTarget), with other noise and another tenth of the object hidden; the thesis took 1000"},
      {"faults", "noise 6 grey values and blur 1 px, in the reference view too"},
      {"decomposition", "prior normal straight ahead; no least translation"}};
}
} // namespace thesisReport
