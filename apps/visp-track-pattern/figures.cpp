/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "report.h"

#include "plot.h"

#include <algorithm>
#include <cmath>

namespace trackPattern
{
namespace
{
constexpr const char *BLUE = "#2b6cb0";
constexpr const char *RED = "#c05621";
constexpr const char *DARK = "#444444";
constexpr const char *LIGHT = "#9aa5b1";

std::vector<double> numbersOf(const RunResults &results)
{
  std::vector<double> numbers;
  for (const FrameRecord &frame : results.frames) {
    numbers.push_back(frame.number);
  }
  return numbers;
}

vpApp::PlotCurve curve(const std::string &label, const char *colour, std::vector<double> x, std::vector<double> y,
                       vpApp::PlotStyle style = vpApp::PlotStyle::Solid)
{
  vpApp::PlotCurve result;
  result.label = label;
  result.colour = colour;
  result.style = style;
  result.width = style == vpApp::PlotStyle::Points ? 1.6 : 1.5;
  result.x = std::move(x);
  result.y = std::move(y);
  return result;
}

vpApp::Plot plotOf(const std::string &title, const std::string &yLabel)
{
  vpApp::Plot plot;
  plot.title = title;
  plot.xLabel = "image";
  plot.yLabel = yLabel;
  plot.height = 340;
  return plot;
}

std::vector<double> difference(const std::vector<double> &a, const std::vector<double> &b)
{
  std::vector<double> result(a.size());
  std::transform(a.begin(), a.end(), b.begin(), result.begin(), [](double x, double y) { return x - y; });
  return result;
}

struct StatusLook {
  vpPatternStatus status;
  const char *colour;
  const char *sentence;
};
constexpr StatusLook LOOKS[] = {{vpPatternStatus::Acquiring, "#f0a030", "Acquiring"},
                                {vpPatternStatus::Tracking, "#3fa34d", "Tracking"},
                                {vpPatternStatus::Degraded, "#e6d13a", "Degraded"},
                                {vpPatternStatus::Lost, "#c8322b", "Lost"}};

const char *colourOf(vpPatternStatus status)
{
  for (const StatusLook &look : LOOKS) {
    if (look.status == status) {
      return look.colour;
    }
  }
  return "#000000";
}

//! Largest number of the form 1, 2 or 5 times a power of ten that does not exceed \e value.
double roundBelow(double value)
{
  const double power = std::pow(10., std::floor(std::log10(value)));
  return (value >= 5. * power ? 5. : value >= 2. * power ? 2. : 1.) * power;
}

constexpr const char *FONT = "font-family=\"DejaVu Sans,Helvetica,Arial,sans-serif\"";
} // namespace

std::string motionFigure(const RunResults &results)
{
  vpApp::Plot plot = plotOf("Displacement since the image before", "px");
  const std::vector<double> x = numbersOf(results);
  if (results.hasTruth) {
    plot.curves.push_back(curve("true, x", LIGHT, x, column(results, &FrameRecord::trueDx)));
    plot.curves.push_back(curve("true, y", LIGHT, x, column(results, &FrameRecord::trueDy), vpApp::PlotStyle::Dashed));
  }
  const auto style = results.frames.size() > 400 ? vpApp::PlotStyle::Solid : vpApp::PlotStyle::Points;
  plot.curves.push_back(curve("found, x", BLUE, x, column(results, &FrameRecord::dx), style));
  plot.curves.push_back(curve("found, y", RED, x, column(results, &FrameRecord::dy), style));
  return vpApp::renderSvg(plot);
}

std::string errorFigure(const RunResults &results)
{
  vpApp::Plot plot = plotOf("Displacement, found minus true", "px");
  const std::vector<double> x = numbersOf(results);
  plot.curves.push_back(
      curve("x", BLUE, x, difference(column(results, &FrameRecord::dx), column(results, &FrameRecord::trueDx))));
  plot.curves.push_back(
      curve("y", RED, x, difference(column(results, &FrameRecord::dy), column(results, &FrameRecord::trueDy))));
  return vpApp::renderSvg(plot);
}

std::string sigmaFigure(const RunResults &results)
{
  // During learning, and for the first displacement after it, they may be a hundred times larger and would flatten the
  // rest.
  RunResults shown;
  const bool learned = results.count(vpPatternStatus::Tracking) > 1;
  bool before = false;
  for (const FrameRecord &frame : results.frames) {
    const bool acquiring = frame.status == vpPatternStatus::Acquiring;
    if (!learned || (before && !acquiring)) {
      shown.frames.push_back(frame);
    }
    before = !acquiring;
  }
  vpApp::Plot plot = plotOf("Standard deviations, as the tracker says", "px");
  const std::vector<double> x = numbersOf(shown);
  plot.fromZero = true;
  plot.curves.push_back(curve("a cell, x (median)", BLUE, x, column(shown, &FrameRecord::sigmaX)));
  plot.curves.push_back(curve("a cell, y (median)", RED, x, column(shown, &FrameRecord::sigmaY)));
  plot.curves.push_back(
      curve("displacement, x", BLUE, x, column(shown, &FrameRecord::sigmaDx), vpApp::PlotStyle::Dashed));
  plot.curves.push_back(
      curve("displacement, y", RED, x, column(shown, &FrameRecord::sigmaDy), vpApp::PlotStyle::Dashed));
  return vpApp::renderSvg(plot);
}

std::string timeFigure(const RunResults &results)
{
  constexpr int bins = 60;
  const std::vector<double> times = column(results, &FrameRecord::microseconds);
  const double end = 1.2 * std::max(quantile(times, 0.98), 1e-3);
  std::vector<double> counts(bins, 0.);
  for (const double time : times) {
    if (time < end) {
      counts[static_cast<std::size_t>(std::min(bins - 1., std::floor(bins * time / end)))] += 1.;
    }
  }
  vpApp::Plot plot = plotOf("Time of the tracker per image", "number of images");
  plot.xLabel = "us";
  plot.fromZero = true;
  plot.xRange = {0., end};
  std::vector<double> x, y;
  for (int i = 0; i < bins; ++i) { // one step per bin
    for (const int side : {0, 1}) {
      x.push_back(end * (i + side) / bins);
      y.push_back(counts[static_cast<std::size_t>(i)]);
    }
  }
  plot.curves.push_back(curve("", DARK, x, y));
  const double median = quantile(times, 0.5);
  plot.marks.push_back({median, text("median %.3g us", median)});
  return vpApp::renderSvg(plot);
}

std::string statusFigure(const RunResults &results)
{
  constexpr double left = 20., width = 920., top = 14., height = 34.;
  const double step = width / static_cast<double>(results.frames.size());
  std::string svg = text("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 960 112\" %s font-size=\"14\">"
                         "<rect width=\"960\" height=\"112\" fill=\"#ffffff\"/>",
                         FONT);
  for (std::size_t i = 0; i < results.frames.size();) { // consecutive images of one status form one bar
    std::size_t end = i;
    while (end < results.frames.size() && results.frames[end].status == results.frames[i].status) {
      ++end;
    }
    svg += text("<rect x=\"%.2f\" y=\"%.0f\" width=\"%.2f\" height=\"%.0f\" fill=\"%s\"><title>images %u to %u: "
                "%s</title></rect>",
                left + step * static_cast<double>(i), top, step * static_cast<double>(end - i), height,
                colourOf(results.frames[i].status), results.frames[i].number, results.frames[end - 1].number,
                vpToString(results.frames[i].status));
    i = end;
  }
  svg += text("<text x=\"%.0f\" y=\"66\">image %u</text><text x=\"%.0f\" y=\"66\" text-anchor=\"end\">image %u</text>",
              left, results.frames.front().number, left + width, results.frames.back().number);
  double x = left;
  for (const StatusLook &look : LOOKS) {
    const std::string label = text("%s: %zu", look.sentence, results.count(look.status));
    svg += text("<rect x=\"%.0f\" y=\"84\" width=\"14\" height=\"14\" fill=\"%s\"/><text x=\"%.0f\" y=\"96\">%s</text>",
                x, look.colour, x + 20., label.c_str());
    x += 60. + 9. * static_cast<double>(label.size());
  }
  return svg + "</svg>";
}

DeviationMap deviationMap(const RunResults &results)
{
  DeviationMap map;
  std::map<unsigned int, std::size_t> sizes;
  for (const auto &entry : results.deviations) {
    ++sizes[std::get<0>(entry.first)];
  }
  if (sizes.empty() || !(results.lattice.columnPitch() > 0.)) {
    return map;
  }
  const unsigned int epoch = std::max_element(sizes.begin(), sizes.end(), [](const auto &a, const auto &b) {
                               return a.second < b.second;
                             })->first;
  // Positions on the regular lattice, without rotation of the product.
  const double pitchX = results.lattice.columnPitch(), pitchY = results.lattice.rowPitch();
  struct Arrow {
    double x, y, dx, dy;
  };
  std::vector<Arrow> arrows;
  double least[2] = {HUGE_VAL, HUGE_VAL}, most[2] = {-HUGE_VAL, -HUGE_VAL}, squares[2] = {0., 0.};
  const double c = std::cos(results.lattice.angle()), s = std::sin(results.lattice.angle());
  std::vector<double> lengthX, lengthY;
  for (const auto &[name, deviation] : results.deviations) {
    if (std::get<0>(name) == epoch) {
      const Arrow arrow{std::get<2>(name) * pitchX, std::get<1>(name) * pitchY, c * deviation.x + s * deviation.y,
                        c * deviation.y - s * deviation.x};
      arrows.push_back(arrow);
      least[0] = std::min(least[0], arrow.x);
      least[1] = std::min(least[1], arrow.y);
      most[0] = std::max(most[0], arrow.x);
      most[1] = std::max(most[1], arrow.y);
      squares[0] += arrow.dx * arrow.dx;
      squares[1] += arrow.dy * arrow.dy;
      lengthX.push_back(std::abs(arrow.dx));
      lengthY.push_back(std::abs(arrow.dy));
    }
  }
  map.cells = arrows.size();
  map.rmsX = std::sqrt(squares[0] / static_cast<double>(map.cells));
  map.rmsY = std::sqrt(squares[1] / static_cast<double>(map.cells));
  // The longest arrows nearly reach the neighbour.
  const double wanted = 0.8 * std::min(pitchX / std::max(quantile(lengthX, 0.95), 1e-6),
                                       pitchY / std::max(quantile(lengthY, 0.95), 1e-6));
  map.factor = roundBelow(wanted);

  constexpr double border = 40., width = 960.;
  const double zoom = std::min((width - 2. * border) / std::max(most[0] - least[0], pitchX),
                               700. / std::max(most[1] - least[1], pitchY));
  const double shift = 0.5 * (width - zoom * (most[0] - least[0]));
  const double height = zoom * (most[1] - least[1]) + 2. * border + 30.;
  map.svg = text("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" %s font-size=\"14\">"
                 "<rect width=\"%.0f\" height=\"%.0f\" fill=\"#ffffff\"/>",
                 width, height, FONT, width, height);
  const double head = std::clamp(0.06 * zoom * std::min(pitchX, pitchY), 1.5, 4.);
  for (const Arrow &arrow : arrows) {
    const double x = shift + zoom * (arrow.x - least[0]), y = border + zoom * (arrow.y - least[1]);
    const double endX = x + zoom * map.factor * arrow.dx, endY = y + zoom * map.factor * arrow.dy;
    map.svg += text("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"%s\"/><line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" "
                    "y2=\"%.1f\" stroke=\"%s\" stroke-width=\"1.6\"/><circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" "
                    "fill=\"%s\"/>",
                    x, y, 0.7 * head, LIGHT, x, y, endX, endY, BLUE, endX, endY, head, BLUE);
  }
  // Reference arrow of a round length, at most an eighth of the figure.
  const double longest = width / 8. / (zoom * map.factor);
  const double sample = roundBelow(longest);
  const double sampleLength = zoom * map.factor * sample;
  map.svg += text("<line x1=\"%.0f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"2.5\"/>"
                  "<text x=\"%.1f\" y=\"%.1f\">%g px</text></svg>",
                  border, height - 18., border + sampleLength, height - 18., DARK, border + sampleLength + 10.,
                  height - 13., sample);
  return map;
}
} // namespace trackPattern
