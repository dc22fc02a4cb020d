/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Time of a step of each class. Peers for the Kalman filter: OpenCV's cv::KalmanFilter with the same states.
#include "vpBenchmark.h"

#include <visp3/printing/vpAlphaBetaFilter.h>
#include <visp3/printing/vpFrictionIdentification.h>
#include <visp3/printing/vpMotionKalmanFilter.h>
#include <visp3/printing/vpMotionObserver.h>
#include <visp3/printing/vpPreviewControl.h>
#include <visp3/printing/vpPrintReference.h>
#include <visp3/printing/vpPrintTrigger.h>
#include <visp3/printing/vpPrintVelocityControl.h>
#include <visp3/printing/vpProductOdometer.h>

#include <opencv2/video/tracking.hpp>

#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace
{
constexpr double pitch = 220. / 4.5;

//! The cells of three columns and five rows, moved by x.
void look(double x, std::vector<vpPatternCell> &cells)
{
  cells.clear();
  const int first = -static_cast<int>(x / pitch) - 1;
  for (int row = -2; row <= 2; ++row) {
    for (int column = first; column < first + 3; ++column) {
      vpPatternCell cell;
      cell.row = row;
      cell.column = column;
      cell.x = 79.5 + column * pitch + x;
      cell.y = 49.5 + 17.8 * row;
      cell.sigmaX = cell.sigmaY = 0.0153;
      cell.valid = true;
      cells.push_back(cell);
    }
  }
}

void alphaBeta(benchmark::State &state)
{
  vpAlphaBetaFilter filter;
  double z = 0.;
  for (auto _ : state) {
    double value = filter.step(z += 5.).value;
    benchmark::DoNotOptimize(value);
  }
}
BENCHMARK(alphaBeta);

void kalman(benchmark::State &state)
{
  vpMotionKalmanSpec spec;
  spec.maxDelay = 0.;
  vpMotionKalmanFilter filter(spec);
  double t = 0.;
  for (auto _ : state) {
    t += 1.;
    filter.add({vpMotionReadingKind::Position, t, 5. * t, 0.1});
    benchmark::DoNotOptimize(filter.at(t + 1.28).velocity);
  }
}
BENCHMARK(kalman);

// The same three states, 64 bit; without time stamps, encoder, gate or displacement.
void kalmanOpenCV(benchmark::State &state)
{
  cv::KalmanFilter filter(3, 1, 0, CV_64F);
  filter.transitionMatrix = (cv::Mat_<double>(3, 3) << 1, 1, 0.5, 0, 1, 1, 0, 0, 1);
  filter.measurementMatrix = (cv::Mat_<double>(1, 3) << 1, 0, 0);
  filter.processNoiseCov =
      1e-3 * (cv::Mat_<double>(3, 3) << 0.05, 0.125, 1. / 6., 0.125, 1. / 3., 0.5, 1. / 6., 0.5, 1.);
  filter.measurementNoiseCov = (cv::Mat_<double>(1, 1) << 0.01);
  filter.errorCovPost = cv::Mat::eye(3, 3, CV_64F);
  cv::Mat z(1, 1, CV_64F);
  double t = 0.;
  for (auto _ : state) {
    t += 1.;
    z.at<double>(0) = 5. * t;
    filter.predict();
    double rate = filter.correct(z).at<double>(1);
    benchmark::DoNotOptimize(rate);
  }
}
BENCHMARK(kalmanOpenCV);

void odometer(benchmark::State &state)
{
  vpProductOdometer meter;
  std::vector<std::vector<vpPatternCell>> frames(100);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    look(5. * static_cast<double>(i), frames[i]);
  }
  std::size_t k = 0;
  for (auto _ : state) {
    k = (k + 1) % frames.size();
    double x = meter.step(frames[k].data(), frames[k].size(), 0).x;
    benchmark::DoNotOptimize(x);
  }
}
BENCHMARK(odometer);

void observer(benchmark::State &state)
{
  vpMotionObserver watch;
  double t = 0.;
  for (auto _ : state) {
    t += 1.;
    watch.measure(t - 1.28, 0., 0.1);
    watch.command(t, 0.05);
    benchmark::DoNotOptimize(watch.at(t).velocity);
  }
}
BENCHMARK(observer);

void velocityControl(benchmark::State &state)
{
  vpPrintVelocityControl control(vpPrintVelocityControlSpec::thesisFeedforward());
  for (auto _ : state) {
    benchmark::DoNotOptimize(control.step({4., 0.1, 3.9}).force);
  }
}
BENCHMARK(velocityControl);

void previewControl(benchmark::State &state)
{
  const vpPreviewControl control;
  const vpPreviewControl::Input input{{{0., 4., 0.1, 0.1}}, {{0., 4., 0.1, 0.1}}, 0., 3.9, 0.01};
  for (auto _ : state) {
    benchmark::DoNotOptimize(control.command(input).force);
  }
}
BENCHMARK(previewControl);

void reference(benchmark::State &state)
{
  vpPrintReference motion;
  std::vector<vpPrintTarget> targets(3);
  double now = 0.;
  for (auto _ : state) {
    now += 1.;
    const long key = static_cast<long>(now / 9.7778);
    for (std::size_t i = 0; i < targets.size(); ++i) {
      targets[i].key = key + static_cast<long>(i);
      targets[i].position =
          pitch * static_cast<double>(targets[i].key + 1) + 0.01 * static_cast<double>(static_cast<long>(now) % 3);
    }
    double velocity = motion.step(now, targets.data(), targets.size()).state[1];
    benchmark::DoNotOptimize(velocity);
  }
}
BENCHMARK(reference);

void trigger(benchmark::State &state)
{
  vpPrintTriggerSpec spec;
  spec.rowTolerance = 7.;
  vpPrintTrigger head(spec);
  std::vector<vpPatternCell> cells;
  vpPrintTriggerInput input;
  double now = 0.;
  for (auto _ : state) {
    now += 1.;
    look(5. * now, cells); // about 0.1 us of the time
    input.time = input.captureTime = input.along.time = now;
    input.captureAlong = input.along.position = 5. * now;
    input.along.velocity = 5.;
    input.cells = cells.data();
    input.cellCount = cells.size();
    int shots = head.step(input).shotCount;
    benchmark::DoNotOptimize(shots);
  }
}
BENCHMARK(trigger);

void frictionIdentification(benchmark::State &state)
{
  vpFrictionModel model;
  model.viscous = 0.02;
  model.coulomb = 0.08;
  model.stiction = 0.12;
  model.stribeckVelocity = 0.3;
  std::vector<vpFrictionSample> log;
  for (int k = 1; k < 480; ++k) {
    const double v = 0.0125 * k, a = k % 2 == 0 ? 0.05 : -0.05;
    log.push_back({model.force(v, a), v, a});
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(vpIdentifyFriction(log).model.mass);
  }
}
BENCHMARK(frictionIdentification)->Unit(benchmark::kMillisecond);
} // namespace

VP_BENCHMARK_MAIN();
