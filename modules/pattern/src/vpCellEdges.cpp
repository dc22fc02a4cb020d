/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCellEdges.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

BEGIN_VISP_NAMESPACE

namespace
{
// The image along one axis: along(position, line) for either axis, with the border repeated.
struct View {
  const vpImage<unsigned char> &image;
  bool vertical;
  int length() const { return static_cast<int>(vertical ? image.getHeight() : image.getWidth()); }
  int lines() const { return static_cast<int>(vertical ? image.getWidth() : image.getHeight()); }
  int at(int position, int line) const
  {
    const auto p = static_cast<unsigned int>(std::clamp(position, 0, length() - 1));
    const auto l = static_cast<unsigned int>(std::clamp(line, 0, lines() - 1));
    return vertical ? image[p][l] : image[l][p];
  }
};

// Crossing of the level between two neighbouring pixels with the values a and b, in steps from a; or NaN.
double crossing(double a, double b) { return a * b > 0. || a == b ? NAN : a / (a - b); }

// Mean of the midpoints between both edges over the middle three quarters of the lines. \e along and \e across are the
// memory steps; the box does not touch the border of the image.
double middle(const unsigned char *pixels, std::ptrdiff_t along, std::ptrdiff_t across, int low, int high,
              int firstLine, int lastLine, double level)
{
  const int skip = (lastLine - firstLine + 1) / 8, step = std::max(1, (lastLine - firstLine + 1) / 16);
  const int most = std::min(3, high - low + 2);
  double sum = 0.;
  int count = 0;
  for (int line = firstLine + skip; line <= lastLine - skip; line += step) {
    const unsigned char *from = pixels + line * across;
    const auto value = [&](int position) { return from[position * along] - level; };
    // The box may be a pixel wider than this line, at rounded corners or when the cell is turned.
    double edges[2] = {NAN, NAN};
    for (int k = 0; k < most && std::isnan(edges[0]); ++k) {
      edges[0] = low - 1 + k + crossing(value(low - 1 + k), value(low + k));
    }
    for (int k = 0; k < most && std::isnan(edges[1]); ++k) {
      edges[1] = high + 1 - k - crossing(value(high + 1 - k), value(high - k));
    }
    if (!std::isnan(edges[0]) && !std::isnan(edges[1])) {
      sum += 0.5 * (edges[0] + edges[1]);
      ++count;
    }
  }
  return count > 0 ? sum / count : NAN;
}

double gradient(const View &view, int position, int line, vpPatternDerivative derivative)
{
  const auto difference = [&](int l) { return view.at(position + 1, l) - view.at(position - 1, l); };
  switch (derivative) {
  case vpPatternDerivative::Roberts:
    return std::abs(view.at(position + 1, line) - view.at(position, line));
  case vpPatternDerivative::Prewitt:
    return std::abs(difference(line - 1) + difference(line) + difference(line + 1));
  case vpPatternDerivative::Sobel:
    return std::abs(difference(line - 1) + 2 * difference(line) + difference(line + 1));
  case vpPatternDerivative::Symmetric:
    break;
  }
  return std::abs(difference(line));
}

// Steepest position near an edge: (7.13) and (7.14), mean over three lines. Unguarded, the parabola may diverge.
double steepest(const View &view, int edge, int line, vpPatternDerivative derivative, bool guarded)
{
  double sum = 0.;
  int count = 0;
  for (int l = line - 1; l <= line + 1; ++l) {
    int best = edge;
    for (int p = edge - 2; p <= edge + 2; ++p) {
      best = gradient(view, p, l, derivative) > gradient(view, best, l, derivative) ? p : best;
    }
    const double a = gradient(view, best - 1, l, derivative), b = gradient(view, best, l, derivative);
    const double c = gradient(view, best + 1, l, derivative), curvature = a - 2. * b + c;
    if (curvature == 0. || (guarded && (curvature > 0. || b < a || b < c))) {
      continue;
    }
    sum += best + (a - c) / (2. * curvature);
    ++count;
  }
  // The difference of two neighbours is located between them.
  return count == 0 ? NAN : sum / count + (derivative == vpPatternDerivative::Roberts ? 0.5 : 0.);
}

int roundToInt(double value) { return static_cast<int>(std::lround(value)); }
} // namespace

bool vpHalfMaximumCentre(const vpImage<unsigned char> &image, double level, vpPatternSpot &spot)
{
  const std::ptrdiff_t row = image.getWidth();
  spot.x = middle(image.bitmap, 1, row, spot.left, spot.right, spot.top, spot.bottom, level);
  spot.y = middle(image.bitmap, row, 1, spot.top, spot.bottom, spot.left, spot.right, level);
  return std::isfinite(spot.x) && std::isfinite(spot.y);
}

bool vpThesisCentre(const vpImage<unsigned char> &image, vpPatternDerivative derivative, vpPatternSpot &spot)
{
  const View columns{image, true};
  const double x1 = spot.left + 0.2 * spot.width(), x2 = spot.left + 0.8 * spot.width();
  const double leftUp = steepest(columns, spot.top, roundToInt(x1), derivative, false);
  const double leftDown = steepest(columns, spot.bottom, roundToInt(x1), derivative, false);
  const double rightUp = steepest(columns, spot.top, roundToInt(x2), derivative, false);
  const double rightDown = steepest(columns, spot.bottom, roundToInt(x2), derivative, false);
  const double a1 = (rightDown - leftUp) / (x2 - x1), b1 = leftUp - a1 * x1;
  const double a2 = (rightUp - leftDown) / (x2 - x1), b2 = leftDown - a2 * x1;
  spot.x = (b2 - b1) / (a1 - a2);
  spot.y = spot.x * a2 + b2;
  return std::isfinite(spot.x) && std::isfinite(spot.y);
}

bool vpThesisCentreFixed(const vpImage<unsigned char> &image, vpPatternDerivative derivative, vpPatternSpot &spot)
{
  const View columns{image, true}, rows{image, false};
  spot.x = spot.y = 0.;
  for (const double part : {0.2, 0.8}) {
    const int column = roundToInt(spot.left + part * (spot.width() - 1));
    const int row = roundToInt(spot.top + part * (spot.height() - 1));
    spot.y += 0.25 * (steepest(columns, spot.top, column, derivative, true) +
                      steepest(columns, spot.bottom, column, derivative, true));
    spot.x +=
        0.25 * (steepest(rows, spot.left, row, derivative, true) + steepest(rows, spot.right, row, derivative, true));
  }
  return std::isfinite(spot.x) && std::isfinite(spot.y);
}

END_VISP_NAMESPACE
