/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Otsu, Isodata and minimum error on one set of cumulated moments.
#include <visp3/pattern/vpPatternThreshold.h>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
// Weight, mean and variance of the two classes of a threshold.
struct Classes {
  double darkWeight, brightWeight, darkMean, brightMean, darkVariance, brightVariance;
};

// Moments of the values up to each grey value.
class Moments
{
public:
  explicit Moments(const vpPatternHistogram &histogram)
  {
    double n = 0., s = 0., q = 0.;
    for (std::size_t g = 0; g < 256; ++g) {
      const double h = histogram[g], value = static_cast<double>(g);
      n += h;
      s += h * value;
      q += h * value * value;
      m_n[g] = n;
      m_s[g] = s;
      m_q[g] = q;
    }
  }
  double count() const { return m_n[255]; }
  double mean() const { return m_s[255] / m_n[255]; }
  double variance() const { return m_q[255] / m_n[255] - mean() * mean(); }
  bool divides(std::size_t g) const { return m_n[g] > 0. && m_n[g] < m_n[255]; }
  double between(std::size_t g) const // times count squared
  {
    const double d = m_s[g] * m_n[255] - m_s[255] * m_n[g];
    return d * d / (m_n[g] * (m_n[255] - m_n[g]));
  }
  Classes classes(std::size_t g) const
  {
    const double n0 = m_n[g], n1 = m_n[255] - n0, m0 = m_s[g] / n0, m1 = (m_s[255] - m_s[g]) / n1;
    return {n0 / m_n[255],
            n1 / m_n[255],
            m0,
            m1,
            std::max(0., m_q[g] / n0 - m0 * m0),
            std::max(0., (m_q[255] - m_q[g]) / n1 - m1 * m1)};
  }

private:
  std::array<double, 256> m_n{}, m_s{}, m_q{};
};

std::size_t otsu(const Moments &moments)
{
  std::size_t best = 0;
  double most = -1.;
  for (std::size_t g = 0; g < 255; ++g) {
    if (moments.divides(g) && moments.between(g) > most) {
      most = moments.between(g);
      best = g;
    }
  }
  return best;
}

std::size_t isodata(const Moments &moments)
{
  std::size_t g = static_cast<std::size_t>(moments.mean());
  for (int i = 0; i < 256 && moments.divides(g); ++i) {
    const Classes c = moments.classes(g);
    const std::size_t next = static_cast<std::size_t>(0.5 * (c.darkMean + c.brightMean));
    if (next == g) {
      break;
    }
    g = next;
  }
  return g;
}

std::size_t minimumError(const Moments &moments)
{
  std::size_t best = otsu(moments);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t g = 0; g < 255; ++g) {
    if (!moments.divides(g)) {
      continue;
    }
    const Classes c = moments.classes(g);
    // A class of one grey value would have the error minus infinity: rounding alone has the variance 1/12.
    const double v0 = c.darkVariance + 1. / 12., v1 = c.brightVariance + 1. / 12.;
    const double error = c.darkWeight * (std::log(v0) - 2. * std::log(c.darkWeight)) +
                         c.brightWeight * (std::log(v1) - 2. * std::log(c.brightWeight));
    if (error < least) {
      least = error;
      best = g;
    }
  }
  return best;
}
} // namespace

vpPatternThresholdResult vpFindThreshold(const vpPatternHistogram &histogram, vpPatternThreshold method)
{
  const Moments moments(histogram);
  vpPatternThresholdResult result;
  if (moments.count() <= 0. || moments.variance() < 1e-9) {
    return result;
  }
  std::size_t g = method == vpPatternThreshold::Isodata        ? isodata(moments)
                  : method == vpPatternThreshold::MinimumError ? minimumError(moments)
                                                               : otsu(moments);
  if (!moments.divides(g)) {
    g = otsu(moments);
  }
  const Classes c = moments.classes(g);
  result.threshold = static_cast<int>(g);
  result.separability = moments.between(g) / (moments.count() * moments.count() * moments.variance());
  result.darkMean = c.darkMean;
  result.brightMean = c.brightMean;
  return result;
}

const char *vpToString(vpPatternThreshold method)
{
  switch (method) {
  case vpPatternThreshold::Isodata:
    return "Isodata";
  case vpPatternThreshold::MinimumError:
    return "MinimumError";
  case vpPatternThreshold::Otsu:
    break;
  }
  return "Otsu";
}

END_VISP_NAMESPACE
