/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "figures.h"

#include "film.h"

#include "numberText.h"
#include "runPicture.h"
#include "timePlot.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace avoidObstacle
{
namespace
{
using vpApp::Plot;
using vpApp::PlotCurve;
using vpApp::PlotStyle;

constexpr std::size_t CURVE_POINTS = 800; // more would not be visible
constexpr double CUT = 3.;                // in units of the bound of a: larger values are drawn there
constexpr double FAR = 300.;              // mm of clearance: larger values are drawn there
const char *const COLOURS[] = {"#1f77b4", "#d62728", "#2ca02c", "#ff7f0e", "#9467bd", "#8c564b", "#17becf", "#7f7f7f"};

PlotCurve curveOf(const std::string &label, const std::string &colour)
{
  PlotCurve curve;
  curve.label = label;
  curve.colour = colour;
  curve.width = 1.6;
  return curve;
}

PlotCurve overTime(const vpAvoidanceRun &run, const std::string &label, const std::string &colour,
                   const std::function<double(std::size_t)> &value, vpApp::Keep keep = vpApp::Keep::Largest)
{
  return vpApp::timeCurve(
      label, colour, run.samples.size(), [&](std::size_t i) { return run.samples[i].time; }, value, keep);
}

Plot jointSpeeds(const vpAvoidanceRun &run)
{
  Plot plot = vpApp::timePlot("Joint speeds as parts of their limits", "share");
  const auto &joints = run.spec.arm->spec().joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    plot.curves.push_back(overTime(run, joints[j].name, COLOURS[j % 8], [&](std::size_t i) {
      return std::fabs(run.samples[i].command(static_cast<Eigen::Index>(j))) / joints[j].velocity;
    }));
  }
  vpApp::addLevel(plot, 1., "limit");
  return plot;
}

//! Columns of the track table over time, downsampled.
PlotCurve ofTrack(const SensorLog &sensorLog, const std::string &object, const std::string &label,
                  const std::string &colour, const std::function<double(const TrackRow &)> &value)
{
  PlotCurve curve = curveOf(label, colour);
  const std::size_t stride = std::max<std::size_t>(1, sensorLog.tracks.size() / CURVE_POINTS);
  std::size_t count = 0;
  for (const TrackRow &row : sensorLog.tracks) {
    if (row.track.name == object && count++ % stride == 0) {
      curve.x.push_back(row.time);
      curve.y.push_back(value(row));
    }
  }
  return curve;
}

PlotCurve sightErrors(const SensorLog &sensorLog, const std::string &object, const std::string &colour)
{
  PlotCurve curve = curveOf(object + ", error of sightings", colour);
  curve.style = PlotStyle::Points;
  for (const Frame &frame : sensorLog.frames) {
    for (const Sight &sight : frame.sights) {
      if (sight.object == object && sight.seen) {
        curve.x.push_back(frame.time);
        curve.y.push_back(1000. * sight.error);
      }
    }
  }
  return curve;
}

//! All names that occurred in the track table.
std::vector<std::string> namesOf(const PhotoScene &scene, const SensorLog &sensorLog)
{
  std::vector<std::string> names;
  for (const vpMovingObstacle &obstacle : scene.obstacles) {
    names.push_back(obstacle.object.name);
  }
  for (const TrackRow &row : sensorLog.tracks) {
    if (std::find(names.begin(), names.end(), row.track.name) == names.end()) {
      names.push_back(row.track.name);
    }
  }
  return names;
}
} // namespace

Rates ratesOf(const std::vector<Eigen::Vector3d> &places, double period)
{
  Rates rates;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector3d v = i == 0 ? before : (places[i] - places[i - 1]) / period;
    rates.speed.push_back(v.norm());
    rates.acceleration.push_back((v - before).norm() / period);
    before = v;
  }
  return rates;
}

std::vector<Eigen::Vector3d> commandedWay(const vpAvoidanceRun &run)
{
  std::vector<Eigen::Vector3d> way;
  vpArmData data;
  for (const vpAvoidanceSample &s : run.samples) {
    vpArmKinematics::forward(*run.spec.arm, s.commanded, data);
    way.push_back(data.tool.p);
  }
  return way;
}

Figure drawTimes(const vpAvoidanceRun &run)
{
  const vpAvoidanceMethodSpec &limits = run.spec.methodSpec;
  const Rates rates = ratesOf(commandedWay(run), limits.period);
  std::vector<Plot> panels;
  panels.push_back(vpApp::timePlot("Speed of the commanded tool", "m/s"));
  panels.back().curves.push_back(overTime(run, "speed", COLOURS[0], [&](std::size_t i) { return rates.speed[i]; }));
  vpApp::addLevel(panels.back(), limits.maxVelocity, "bound");
  panels.push_back(vpApp::timePlot("Acceleration of the commanded tool", "m/s^2"));
  panels.back().curves.push_back(overTime(run, "acceleration", COLOURS[0], [&](std::size_t i) {
    return std::min(rates.acceleration[i], CUT * limits.maxAcceleration);
  }));
  vpApp::addLevel(panels.back(), limits.maxAcceleration, "bound");
  panels.push_back(jointSpeeds(run));
  panels.push_back(vpApp::timePlot("Least clearance of the whole arm, true scene", "mm"));
  panels.back().curves.push_back(overTime(
      run, "clearance", COLOURS[0],
      [&](std::size_t i) { return std::min(FAR, 1000. * run.samples[i].clearance.distance); }, vpApp::Keep::Least));
  vpApp::addLevel(panels.back(), 0., "touching");
  panels.push_back(vpApp::timePlot("Distance of the tool from the goal", "mm"));
  panels.back().curves.push_back(
      overTime(run, "distance", COLOURS[0], [&](std::size_t i) { return 1000. * run.samples[i].goalDistance; }));
  Figure figure;
  figure.name = "times";
  figure.title = "Tool, joints and clearance over time";
  figure.caption = "Accelerations above three times the bound are drawn there, clearances above 300 mm, too. The "
                   "clearance is the least of all pairs of parts that must not touch, the arm's own among them.";
  figure.svg = vpApp::renderPanels(panels, vpApp::PlotFormat::Svg);
  return figure;
}

Figure drawTracks(const PhotoScene &scene, const Episode &episode)
{
  std::vector<Plot> panels = {
      vpApp::timePlot("Errors of place, and what the track table adds to the obstacle for them", "mm"),
      vpApp::timePlot("Speed in the track table", "m/s"), vpApp::timePlot("Confidence in the track table", "0..1")};
  const SensorLog &sensorLog = episode.sensorLog;
  const std::vector<std::string> names = namesOf(scene, sensorLog);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string &name = names[i], colour = COLOURS[i % 8];
    panels[0].curves.push_back(sightErrors(sensorLog, name, colour));
    panels[0].curves.push_back(
        ofTrack(sensorLog, name, name + ", error of track", colour, [](const TrackRow &r) { return 1000. * r.error; }));
    panels[0].curves.push_back(ofTrack(sensorLog, name, name + ", inflation", colour,
                                       [](const TrackRow &r) { return 1000. * r.track.inflation; }));
    panels[0].curves.back().style = PlotStyle::Dashed;
    panels[1].curves.push_back(
        ofTrack(sensorLog, name, name, colour, [](const TrackRow &r) { return r.track.velocity.linearNorm(); }));
    panels[2].curves.push_back(
        ofTrack(sensorLog, name, name, colour, [](const TrackRow &r) { return r.track.confidence; }));
  }
  for (Plot &plot : panels) {
    plot.curves.erase(std::remove_if(plot.curves.begin(), plot.curves.end(), [](const auto &c) { return c.x.empty(); }),
                      plot.curves.end());
    plot.fromZero = true;
    if (plot.curves.empty()) {
      plot.xRange = {0., episode.run.samples.back().time};
      vpApp::addLevel(plot, 0., "nothing was ever seen");
    }
  }
  Figure figure;
  figure.name = "tracks";
  figure.title = "The track table over time";
  figure.caption = "Points: sightings. The method inflates each obstacle (dashed), which must "
                   "stay above the error of the track; it grows while the obstacle is out of view.";
  figure.svg = vpApp::renderPanels(panels, vpApp::PlotFormat::Svg);
  return figure;
}

PlotCurve wayCurve(const std::string &label, const std::string &colour, const std::vector<Eigen::Vector2d> &way,
                   std::size_t thin)
{
  PlotCurve curve;
  curve.label = label;
  curve.colour = colour;
  for (std::size_t i = 0; i < way.size(); i += thin) {
    curve.x.push_back(way[i].x());
    curve.y.push_back(way[i].y());
  }
  if (!way.empty()) {
    curve.x.push_back(way.back().x());
    curve.y.push_back(way.back().y());
  }
  return curve;
}

PlotCurve placeCurve(const std::string &label, const std::string &colour, const std::vector<Eigen::Vector2d> &places)
{
  PlotCurve curve = wayCurve(label, colour, places);
  curve.style = PlotStyle::Points;
  return curve;
}

Plot wayPlot(const std::string &title)
{
  Plot plot;
  plot.title = title;
  plot.xLabel = "x (m)";
  plot.yLabel = "y (m)";
  plot.equalAxes = true;
  plot.height = 520;
  return plot;
}

namespace
{
constexpr const char *TOOL_COLOUR = "#d62728";
constexpr int VIEWS = 6, VIEW_COLUMNS = 3, VIEW_WIDTH = 320;
} // namespace

Figure drawWay(const vpAvoidanceRun &run, const std::string &title, const std::vector<vpCollisionObject> &believed)
{
  vpApp::ArmPicture picture = vpApp::runPicture(run, title);
  picture.faint = believed;
  picture.traces = {vpApp::toolTrace(run, "tool", TOOL_COLOUR)};
  picture.traces.push_back({{run.samples.front().tool, run.samples.back().goal}, "#777777", true, "straight"});
  Figure figure;
  figure.name = "way";
  figure.title = "The way of the tool from above and from the side";
  figure.caption = "The arm at the start (grey), at the end (dark) and in between (faint); obstacles where they truly "
                   "are when the tool is half way" +
                   std::string(believed.empty() ? "."
                                                : ", dashed as the track table had them in the end, with their "
                                                  "uncertainty.");
  figure.svg = vpApp::armPictureSvg(*run.spec.arm, picture);
  return figure;
}

Figure animate(const vpAvoidanceRun &run, const std::string &title)
{
  vpApp::ArmAnimation animation = vpApp::runAnimation(run, title);
  animation.traces = {vpApp::toolTrace(run, "tool", TOOL_COLOUR)};
  Figure figure;
  figure.name = "animation";
  figure.title = "The same as an animation";
  figure.caption = "Press Play or move the slider.";
  figure.html = vpApp::armAnimationHtml(*run.spec.arm, animation, "way");
  return figure;
}

namespace
{
//! Mostly images in which something was seen, and the last one.
std::vector<std::size_t> shownFrames(const std::vector<Frame> &frames)
{
  std::size_t last = frames.size() - 1;
  const auto isEmpty = [](const Frame &frame) {
    return std::none_of(frame.sights.begin(), frame.sights.end(), [](const Sight &sight) { return sight.seen; });
  };
  while (last > 0 && isEmpty(frames[last])) {
    --last;
  }
  last = last > 0 ? last : frames.size() - 1;
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i + 1 < VIEWS; ++i) {
    shown.push_back(last * i / (VIEWS - 2));
  }
  shown.push_back(frames.size() - 1);
  return shown;
}
} // namespace

Figure drawViews(const Episode &episode)
{
  const std::vector<Frame> &frames = episode.sensorLog.frames;
  const std::vector<std::size_t> shown = frames.empty() ? std::vector<std::size_t>() : shownFrames(frames);
  cv::Mat sheet;
  for (int row = 0; row < VIEWS / VIEW_COLUMNS && !frames.empty(); ++row) {
    cv::Mat line;
    for (int column = 0; column < VIEW_COLUMNS; ++column) {
      const std::size_t i = shown[static_cast<std::size_t>(row * VIEW_COLUMNS + column)];
      cv::Mat view = cameraPicture(frames[i]), tile;
      cv::resize(view, tile, cv::Size(VIEW_WIDTH, VIEW_WIDTH * view.rows / view.cols), 0., 0., cv::INTER_AREA);
      cv::copyMakeBorder(tile, tile, 2, 2, 2, 2, cv::BORDER_CONSTANT, cv::Scalar::all(255));
      line.empty() ? line = tile : (cv::hconcat(line, tile, line), line);
    }
    sheet.empty() ? sheet = line : (cv::vconcat(sheet, line, sheet), sheet);
  }
  Figure figure;
  figure.name = "views";
  figure.title = "What the camera in the hand saw";
  figure.caption = "From the first picture to the last one in which something was seen, and the last of all; what was "
                   "found is outlined.";
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", sheet, bytes, {cv::IMWRITE_JPEG_QUALITY, 88});
  figure.jpeg.assign(bytes.begin(), bytes.end());
  return figure;
}
} // namespace avoidObstacle
