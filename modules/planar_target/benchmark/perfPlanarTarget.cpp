/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Acquisition of a planar target in 640x480 renders, and tracking there and in 1920x1080 (/1080), on one core, compared with ViSP and OpenCV. Each
// benchmark also shows its error: rotation against the render's truth, deg (root mean square over the poses).
#include "../test/vpPlanarScene.h"
#include "vpBenchmark.h"

#include <visp3/planar_target/vpPlanarTarget.h>
#include <visp3/tt/vpTemplateTrackerSSDInverseCompositional.h>
#include <visp3/tt/vpTemplateTrackerWarpHomography.h>
#include <visp3/tt/vpTemplateTrackerZNCCInverseCompositional.h>
#include <visp3/vision/vpKeyPoint.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/video/tracking.hpp>

#include <cstdint>

namespace
{
using Image = vpPlanarScene::Image;

struct View {
  vpHomogeneousMatrix cMo;
  Image image;
};

const vpPlanarScene::Target &klimt()
{
  static const vpPlanarScene::Target target = vpPlanarScene::klimt();
  return target;
}

// Poses throughout the view, every angle within 30 deg.
const std::vector<View> &scattered()
{
  static const std::vector<View> views = []() {
    std::vector<View> all(12);
    std::mt19937_64 rng(7);
    for (View &view : all) {
      view.cMo = vpPlanarScene::randomPose(rng, M_PI / 6.);
      view.image = vpPlanarScene::background(rng);
      vpPlanarScene::draw(view.image, klimt(), vpPlanarScene::camera(), view.cMo);
    }
    return all;
  }();
  return views;
}

// Of 640x480 or, with 1080 rows, 1920x1080 px: the same view, 2.25 times as large.
vpCameraParameters cameraOf(std::int64_t rows)
{
  return rows == 1080 ? vpCameraParameters(1800., 1800., 959.5, 539.5) : vpPlanarScene::camera();
}

std::vector<View> makeSequence(std::int64_t rows)
{
  std::vector<View> all(24);
  std::mt19937_64 rng(8);
  const Image behind = rows == 1080 ? vpPlanarScene::background(rng, 1080, 1920) : vpPlanarScene::background(rng);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double s = i < 12 ? i : 24. - i;
    all[i].cMo = vpPlanarScene::pose(0.002 * s - 0.01, 0.001 * s, 0.52 + 0.002 * s, 0.007 * s, 0.1, 0.007 * s - 0.1);
    all[i].image = behind;
    vpPlanarScene::draw(all[i].image, klimt(), cameraOf(rows), all[i].cMo);
  }
  return all;
}

// A camera that moves: 3 to 4 px of 640 and 0.4 deg per frame, back and forth.
const std::vector<View> &sequence(std::int64_t rows = 480)
{
  static const std::vector<View> small = makeSequence(480);
  if (rows != 1080) {
    return small;
  }
  static const std::vector<View> large = makeSequence(1080);
  return large;
}

cv::Mat view(const Image &image)
{
  return cv::Mat(static_cast<int>(image.getHeight()), static_cast<int>(image.getWidth()), CV_8UC1, image.bitmap);
}

// Pose from a homography of reference pixels to frame pixels, for methods that give only that: IPPE on a grid.
vpHomogeneousMatrix poseOf(const cv::Mat &H, std::int64_t rows = 480)
{
  const double W = klimt().image.getWidth(), Hh = klimt().image.getHeight();
  std::vector<cv::Point2f> reference, image;
  std::vector<cv::Point3f> object;
  for (double u = 0.; u < W; u += W / 6.) {
    for (double v = 0.; v < Hh; v += Hh / 6.) {
      reference.emplace_back(static_cast<float>(u), static_cast<float>(v));
      object.emplace_back(static_cast<float>(((u + 0.5) / W - 0.5) * klimt().width),
                          static_cast<float>(((v + 0.5) / Hh - 0.5) * klimt().height), 0.f);
    }
  }
  cv::perspectiveTransform(reference, image, H);
  cv::Mat rvec, tvec, R;
  const vpCameraParameters camera = cameraOf(rows);
  const cv::Matx33d K(camera.get_px(), 0., camera.get_u0(), 0., camera.get_py(), camera.get_v0(), 0., 0., 1.);
  cv::solvePnP(object, image, K, cv::noArray(), rvec, tvec, false, cv::SOLVEPNP_IPPE);
  cv::Rodrigues(rvec, R);
  vpHomogeneousMatrix M;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      M[static_cast<unsigned int>(r)][static_cast<unsigned int>(c)] = R.at<double>(r, c);
    }
    M[static_cast<unsigned int>(r)][3] = tvec.at<double>(r);
  }
  return M;
}

class Error
{
public:
  void add(const vpHomogeneousMatrix &truth, const vpHomogeneousMatrix &found)
  {
    m_sum2 += vpPlanarScene::rotationError(truth, found).sumSquare();
    ++m_count;
  }
  void miss() { ++m_missed; }
  void report(benchmark::State &state) const
  {
    state.counters["rms_deg"] = m_count > 0 ? std::sqrt(m_sum2 / m_count) : NAN;
    state.counters["missed"] = m_missed / std::max(1., m_count + m_missed);
  }

private:
  double m_sum2 = 0., m_count = 0., m_missed = 0.;
};

void acquire(benchmark::State &state, vpKeypointType type, bool refine)
{
  vpPlanarTargetSpec spec;
  spec.keypoints = type;
  spec.refine = refine;
  spec.fallback = false;
  vpPlanarTarget target(klimt().image, klimt().width, klimt().height, vpPlanarScene::camera(), spec);
  Error error;
  std::size_t i = 0;
  for (auto _ : state) {
    const View &frame = scattered()[i++ % scattered().size()];
    const vpPlanarTargetResult &result = target.acquire(frame.image);
    result.found() ? error.add(frame.cMo, result.cMo) : error.miss();
  }
  error.report(state);
}

void acquireOpenCvOrb(benchmark::State &state)
{
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(1500);
  const cv::BFMatcher matcher(cv::NORM_HAMMING, true);
  std::vector<cv::KeyPoint> reference, current;
  cv::Mat referenceDescriptors, descriptors;
  orb->detectAndCompute(view(klimt().image), cv::noArray(), reference, referenceDescriptors);
  Error error;
  std::size_t i = 0;
  for (auto _ : state) {
    const View &frame = scattered()[i++ % scattered().size()];
    orb->detectAndCompute(view(frame.image), cv::noArray(), current, descriptors);
    std::vector<cv::DMatch> matches;
    matcher.match(referenceDescriptors, descriptors, matches);
    std::vector<cv::Point2f> from, to;
    for (const cv::DMatch &m : matches) {
      from.push_back(reference[static_cast<std::size_t>(m.queryIdx)].pt);
      to.push_back(current[static_cast<std::size_t>(m.trainIdx)].pt);
    }
    const cv::Mat H = cv::findHomography(from, to, cv::RANSAC, 3.);
    H.empty() ? error.miss() : error.add(frame.cMo, poseOf(H));
  }
  error.report(state);
}

void acquireVispKeyPoint(benchmark::State &state)
{
  vpKeyPoint keypoints("ORB", "ORB", "BruteForce-Hamming");
  const Image &photo = klimt().image;
  keypoints.buildReference(photo);
  Error error;
  std::size_t i = 0;
  for (auto _ : state) {
    const View &frame = scattered()[i++ % scattered().size()];
    std::vector<cv::Point2f> from, to;
    keypoints.matchPoint(frame.image);
    std::vector<vpImagePoint> reference, current;
    for (unsigned int k = 0; k < keypoints.getMatchedPointNumber(); ++k) {
      vpImagePoint a, b;
      keypoints.getMatchedPoints(k, a, b);
      from.emplace_back(static_cast<float>(a.get_u()), static_cast<float>(a.get_v()));
      to.emplace_back(static_cast<float>(b.get_u()), static_cast<float>(b.get_v()));
    }
    const cv::Mat H = from.size() >= 4 ? cv::findHomography(from, to, cv::RANSAC, 3.) : cv::Mat();
    H.empty() ? error.miss() : error.add(frame.cMo, poseOf(H));
  }
  error.report(state);
}

void track(benchmark::State &state)
{
  const std::int64_t rows = state.range(0);
  vpPlanarTarget target(klimt().image, klimt().width, klimt().height, cameraOf(rows));
  target.acquire(sequence(rows)[0].image);
  Error error;
  std::size_t i = 1;
  for (auto _ : state) {
    const View &frame = sequence(rows)[i++ % sequence(rows).size()];
    const vpPlanarTargetResult &result = target.track(frame.image);
    if (result.found()) {
      error.add(frame.cMo, result.cMo);
    }
    else {
      error.miss();
      state.PauseTiming();
      target.acquire(frame.image);
      state.ResumeTiming();
    }
  }
  error.report(state);
}

// ViSP's template trackers track the outline given in the first frame, by a homography on its first image.
template <typename Tracker> void trackVispTemplate(benchmark::State &state)
{
  const std::int64_t rows = state.range(0);
  const vpCameraParameters camera = cameraOf(rows);
  vpTemplateTrackerWarpHomography warp;
  Tracker tracker(&warp);
  tracker.setSampling(3, 3);
  tracker.setLambda(0.001);
  tracker.setIterationMax(50);
  tracker.setPyramidal(2, 1);
  const View &first = sequence(rows)[0];
  std::vector<vpImagePoint> triangles;
  const double x = 0.48 * klimt().width, y = 0.48 * klimt().height;
  const double corners[6][2] = {{-x, -y}, {x, -y}, {x, y}, {-x, -y}, {x, y}, {-x, y}};
  for (const auto &c : corners) {
    const vpHomogeneousMatrix &M = first.cMo;
    const double Z = M[2][0] * c[0] + M[2][1] * c[1] + M[2][3];
    triangles.emplace_back(camera.get_v0() + camera.get_py() * (M[1][0] * c[0] + M[1][1] * c[1] + M[1][3]) / Z,
                           camera.get_u0() + camera.get_px() * (M[0][0] * c[0] + M[0][1] * c[1] + M[0][3]) / Z);
  }
  tracker.initFromPoints(first.image, triangles);
  std::size_t i = 1, lost = 0;
  for (auto _ : state) {
    const View &frame = sequence(rows)[i++ % sequence(rows).size()];
    try {
      tracker.track(frame.image);
    }
    catch (const vpException &) {
      ++lost;
      state.PauseTiming();
      tracker.resetTracker();
      i = 1;
      tracker.initFromPoints(first.image, triangles);
      state.ResumeTiming();
    }
  }
  state.counters["lost"] = static_cast<double>(lost);
}

void trackOpenCvEcc(benchmark::State &state)
{
  const cv::Mat reference = view(klimt().image);
  cv::Mat start, H;
  {
    vpPlanarTarget target(klimt().image, klimt().width, klimt().height, vpPlanarScene::camera());
    const vpPlanarTargetResult &r = target.acquire(sequence()[0].image);
    start = cv::Mat(3, 3, CV_64F, const_cast<double *>(r.homography.data())).clone();
  }
  start.convertTo(H, CV_32F);
  const cv::TermCriteria stop(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, 1e-4);
  Error error;
  std::size_t i = 1;
  for (auto _ : state) {
    const View &frame = sequence()[i++ % sequence().size()];
    try {
      cv::findTransformECC(reference, view(frame.image), H, cv::MOTION_HOMOGRAPHY, stop, cv::noArray(), 5);
      error.add(frame.cMo, poseOf(H));
    }
    catch (const cv::Exception &) {
      error.miss();
      i = 1;
      start.convertTo(H, CV_32F);
    }
  }
  error.report(state);
}

void trackOpenCvFlow(benchmark::State &state)
{
  const std::int64_t rows = state.range(0);
  // Points of the reference, tracked from frame to frame, homography each time: it drifts, as such trackers do.
  vpPlanarTarget target(klimt().image, klimt().width, klimt().height, cameraOf(rows));
  std::vector<cv::Point2f> reference, points;
  cv::goodFeaturesToTrack(view(klimt().image), reference, 300, 0.01, 7.);
  const auto restart = [&]() {
    const vpPlanarTargetResult &r = target.acquire(sequence(rows)[0].image);
    cv::perspectiveTransform(reference, points, cv::Mat(3, 3, CV_64F, const_cast<double *>(r.homography.data())));
  };
  restart();
  Error error;
  std::size_t i = 1, frames = 0;
  for (auto _ : state) {
    const View &before = sequence(rows)[(i - 1) % sequence(rows).size()],
               &frame = sequence(rows)[i % sequence(rows).size()];
    ++i;
    std::vector<cv::Point2f> next;
    std::vector<unsigned char> ok;
    std::vector<float> distance;
    cv::calcOpticalFlowPyrLK(view(before.image), view(frame.image), points, next, ok, distance);
    const cv::Mat H = cv::findHomography(reference, next, cv::RANSAC, 3.);
    H.empty() ? error.miss() : error.add(frame.cMo, poseOf(H, rows));
    points = next;
    if (++frames % 24 == 0) {
      state.PauseTiming();
      i = 1;
      restart();
      state.ResumeTiming();
    }
  }
  error.report(state);
}
} // namespace

BENCHMARK_CAPTURE(acquire, ORB, vpKeypointType::ORB, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(acquire, AKAZE, vpKeypointType::AKAZE, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(acquire, ORB_unrefined, vpKeypointType::ORB, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(acquire, SIFT_unrefined, vpKeypointType::SIFT, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(acquire, AKAZE_unrefined, vpKeypointType::AKAZE, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(acquire, KAZE_unrefined, vpKeypointType::KAZE, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(acquire, BRISK_unrefined, vpKeypointType::BRISK, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(acquire, SURF_unrefined, vpKeypointType::SURF, false)->Unit(benchmark::kMillisecond);
BENCHMARK(acquireOpenCvOrb)->Unit(benchmark::kMillisecond);
BENCHMARK(acquireVispKeyPoint)->Unit(benchmark::kMillisecond);
BENCHMARK(track)->Arg(480)->Arg(1080)->Unit(benchmark::kMillisecond);
BENCHMARK(trackVispTemplate<vpTemplateTrackerSSDInverseCompositional>)
    ->Arg(480)
    ->Arg(1080)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(trackVispTemplate<vpTemplateTrackerZNCCInverseCompositional>)
    ->Arg(480)
    ->Arg(1080)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(trackOpenCvEcc)->Unit(benchmark::kMillisecond);
BENCHMARK(trackOpenCvFlow)->Arg(480)->Arg(1080)->Unit(benchmark::kMillisecond);

int main(int argc, char *argv[])
{
  cv::setNumThreads(1);
  // Rendered here and not in whichever benchmark runs first.
  scattered();
  sequence();
  sequence(1080);
  return vpTestSupport::runBenchmarks(argc, argv);
}
