/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpLatticeSearch.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <array>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double share = 0.38;          // of the contrast, from the background: half loses a faint third level
constexpr double overNoise = 6.;        // contrast in standard deviations of the noise
constexpr double flattest = 8.;         // skewness of a window with hardly a spot
constexpr std::size_t candidates = 300; // for the most common size
constexpr double margin = 2.;           // px around the box of all spots

// Sums over a window of columns of f, f^2 and f^3, f being the grey value less 128.
using Sums = std::array<double, 3>;

void addTo(Sums &sums, double f, double sign)
{
  sums[0] += sign * f;
  sums[1] += sign * f * f;
  sums[2] += sign * f * f * f;
}

bool isCompact(const vpPatternSpot &box)
{
  const double w = box.width(), h = box.height();
  return box.area >= 0.45 * w * h && w <= 2.5 * h && h <= 2.5 * w;
}
} // namespace

vpLatticeSpots::vpLatticeSpots(const vpImage<unsigned char> &image, int window)
  : m_image(image), m_low(image.getSize()), m_high(image.getSize()), m_labels(image.getWidth(), image.getHeight(), most)
{
  m_least = overNoise * noise();
  measureLevels(window);
}

// From second differences along the rows.
double vpLatticeSpots::noise() const
{
  std::vector<double> differences;
  for (unsigned int v = 0; v < m_image.getHeight(); v += 3) {
    const unsigned char *row = m_image[v];
    for (unsigned int u = 0; u + 2 < m_image.getWidth(); u += 2) {
      differences.push_back(std::abs(row[u] - 2. * row[u + 1] + row[u + 2]));
    }
  }
  return std::max(0.3, 1.4826 * vpQuantileInPlace(differences.data(), differences.data() + differences.size(), 0.5) /
                           std::sqrt(6.)); // 0.3: rounding to whole grey values
}

// Two levels from mean m, deviation s and skewness g of a window: m + s (g/2 -+ sqrt(1 + g^2/4)), for any shares.
void vpLatticeSpots::measureLevels(int window)
{
  const int width = static_cast<int>(m_image.getWidth()), height = static_cast<int>(m_image.getHeight());
  const int radius = window / 2;
  std::vector<Sums> columns(static_cast<std::size_t>(width), Sums{});
  const auto addRow = [&](int v, double sign) {
    for (int u = 0; u < width; ++u) {
      addTo(columns[static_cast<std::size_t>(u)], m_image[static_cast<unsigned int>(v)][u] - 128., sign);
    }
  };
  for (int v = 0; v < std::min(radius, height); ++v) {
    addRow(v, 1.);
  }
  for (int v = 0; v < height; ++v) {
    if (v + radius < height) {
      addRow(v + radius, 1.);
    }
    if (v - radius > 0) {
      addRow(v - radius - 1, -1.);
    }
    const int rows = std::min(height - 1, v + radius) - std::max(0, v - radius) + 1;
    Sums sums{};
    const auto addColumn = [&](int u, double sign) {
      for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i] += sign * columns[static_cast<std::size_t>(u)][i];
      }
    };
    for (int u = 0; u < std::min(radius, width); ++u) {
      addColumn(u, 1.);
    }
    for (int u = 0; u < width; ++u) {
      if (u + radius < width) {
        addColumn(u + radius, 1.);
      }
      if (u - radius > 0) {
        addColumn(u - radius - 1, -1.);
      }
      const double n = rows * (std::min(width - 1, u + radius) - std::max(0, u - radius) + 1.);
      const double m = sums[0] / n, variance = std::max(1e-9, sums[1] / n - m * m), s = std::sqrt(variance);
      const double third = sums[2] / n - 3. * m * variance - m * m * m;
      const double k = 0.5 * std::clamp(third / (variance * s), -flattest, flattest), root = std::sqrt(1. + k * k);
      const auto pixel = static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
      const bool flat = 2. * s * root < m_least;
      m_low[pixel] = static_cast<float>(flat ? 0. : 128. + m - s * (root - k));
      m_high[pixel] = static_cast<float>(flat ? 0. : 128. + m + s * (root + k));
    }
  }
}

double vpLatticeSpots::above(std::size_t pixel, bool bright) const
{
  const double low = m_low[pixel], high = m_high[pixel], value = m_image.bitmap[pixel];
  return (bright ? value - low : high - value) - share * (high - low);
}

std::vector<vpLatticeSpot> vpLatticeSpots::find(bool bright, double alike)
{
  vpImage<unsigned char> mask(m_image.getHeight(), m_image.getWidth());
  for (std::size_t i = 0; i < m_low.size(); ++i) {
    mask.bitmap[i] = m_high[i] > m_low[i] && above(i, bright) > 0. ? 255 : 0;
  }
  std::vector<vpLatticeSpot> spots;
  if (!m_labels.find(mask, 127, true, vpRunLabels::leastArea)) {
    return spots;
  }
  for (const vpPatternSpot &box : m_labels.spots()) {
    if (!isCompact(box)) {
      continue;
    }
    vpLatticeSpot spot;
    spot.box = box;
    double sum = 0., level = 0.;
    int count = 0;
    for (int v = box.top; v <= box.bottom; ++v) {
      for (int u = box.left; u <= box.right; ++u) {
        const auto pixel = static_cast<std::size_t>(v) * mask.getWidth() + static_cast<std::size_t>(u);
        if (mask.bitmap[pixel] != 0) {
          const double weight = above(pixel, bright);
          sum += weight;
          spot.x += weight * u;
          spot.y += weight * v;
          level += 0.5 * (m_low[pixel] + m_high[pixel]);
          ++count;
        }
      }
    }
    spot.x /= sum;
    spot.y /= sum;
    spot.amplitude = sum / count;
    spot.level = level / count;
    spots.push_back(spot);
  }
  // The most common size by its mass: specks are many but light.
  double heaviest = 0., area = 0., amplitude = 0.;
  const std::size_t step = 1 + spots.size() / candidates;
  for (std::size_t i = 0; i < spots.size(); i += step) {
    const vpLatticeSpot &p = spots[i];
    const auto votes = std::count_if(spots.begin(), spots.end(), [&p](const vpLatticeSpot &q) {
      return q.box.area < 1.6 * p.box.area && p.box.area < 1.6 * q.box.area && q.amplitude < 2. * p.amplitude &&
             p.amplitude < 2. * q.amplitude;
    });
    const double mass = static_cast<double>(votes) * std::sqrt(p.box.area * p.amplitude);
    if (mass > heaviest) {
      heaviest = mass;
      area = p.box.area;
      amplitude = p.amplitude;
    }
  }
  spots.erase(std::remove_if(spots.begin(), spots.end(),
                             [&](const vpLatticeSpot &p) {
                               return p.box.area > alike * area || alike * p.box.area < area ||
                                      p.amplitude < 0.3 * amplitude;
                             }),
              spots.end());
  return spots;
}

vpSpotIndex::vpSpotIndex(const std::vector<vpLatticeSpot> &spots) : m_spots(spots)
{
  m_low.setConstant(1e9);
  m_high.setConstant(-1e9);
  for (const vpLatticeSpot &spot : spots) {
    m_low = m_low.cwiseMin(Eigen::Vector2d(spot.x, spot.y));
    m_high = m_high.cwiseMax(Eigen::Vector2d(spot.x, spot.y));
  }
  m_low.array() -= margin;
  m_high.array() += margin;
  m_cell = std::max(4., std::sqrt(size().prod() / static_cast<double>(std::max<std::size_t>(1, spots.size()))));
  for (const int axis : {0, 1}) {
    m_cells[axis] = static_cast<int>(size()[axis] / m_cell) + 1;
  }
  m_lists.resize(static_cast<std::size_t>(m_cells[0]) * static_cast<std::size_t>(m_cells[1]));
  for (std::size_t i = 0; i < spots.size(); ++i) {
    m_lists[static_cast<std::size_t>(cell(spots[i].y, 1) * m_cells[0] + cell(spots[i].x, 0))].push_back(
        static_cast<int>(i));
  }
}

int vpSpotIndex::cell(double x, int axis) const
{
  return static_cast<int>(std::clamp((x - m_low[axis]) / m_cell, 0., m_cells[axis] - 1.));
}

int vpSpotIndex::nearest(const Eigen::Vector2d &place, double reach) const
{
  int best = -1;
  double least = reach * reach;
  for (int v = cell(place.y() - reach, 1); v <= cell(place.y() + reach, 1); ++v) {
    for (int u = cell(place.x() - reach, 0); u <= cell(place.x() + reach, 0); ++u) {
      for (const int i : m_lists[static_cast<std::size_t>(v * m_cells[0] + u)]) {
        const double d = (this->place(static_cast<std::size_t>(i)) - place).squaredNorm();
        if (d < least) {
          least = d;
          best = i;
        }
      }
    }
  }
  return best;
}

bool vpSpotIndex::inView(const Eigen::Vector2d &place) const
{
  return (place.array() >= m_low.array()).all() && (place.array() <= m_high.array()).all();
}

END_VISP_NAMESPACE
