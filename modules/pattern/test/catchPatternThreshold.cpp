/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Thresholds against ViSP's, an exhaustive search, and known classes. The tracker's own vectorised median is one of the
// values: the middle one, or the upper of two.
#include "../src/vpRobustMean.cpp" // the class is not exported

#include "vpCatch.h"

#include <visp3/core/vpImage.h>
#include <visp3/imgproc/vpImgproc.h>
#include <visp3/pattern/vpPatternThreshold.h>

#include <algorithm>
#include <cmath>
#include <limits>

VISP_DIRECT_USING_NAMESPACE

namespace
{
struct Mixture {
  double dark, bright, sigmaDark, sigmaBright, share;
};

vpImage<unsigned char> draw(std::mt19937_64 &rng, const Mixture &m)
{
  vpImage<unsigned char> image(80, 120);
  std::normal_distribution<double> normal;
  std::bernoulli_distribution isDark(m.share);
  for (unsigned int i = 0; i < image.getSize(); ++i) {
    const bool dark = isDark(rng);
    const double v = dark ? m.dark + m.sigmaDark * normal(rng) : m.bright + m.sigmaBright * normal(rng);
    image.bitmap[i] = static_cast<unsigned char>(std::clamp(std::lround(v), 0L, 255L));
  }
  return image;
}

// ViSP 3.5 has the namespace vp, later ones visp.
int threshold(vpImage<unsigned char> &image, bool otsu)
{
#if (VISP_VERSION_INT >= VP_VERSION_INT(3, 6, 1))
  return visp::autoThreshold(image, otsu ? visp::AUTO_THRESHOLD_OTSU : visp::AUTO_THRESHOLD_ISODATA);
#else
  return vp::autoThreshold(image, otsu ? vp::AUTO_THRESHOLD_OTSU : vp::AUTO_THRESHOLD_ISODATA);
#endif
}

vpPatternHistogram histogram(const vpImage<unsigned char> &image)
{
  vpPatternHistogram h{};
  for (unsigned int i = 0; i < image.getSize(); ++i) {
    ++h[image.bitmap[i]];
  }
  return h;
}
} // namespace

TEST_CASE("thresholds agree with ViSP's and with the definition", "[threshold]")
{
  auto rng = vpTestSupport::generator(410);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> unit(0., 1.);
  for (int k = 0; k < 60; ++k) {
    const Mixture m{40. + 40. * unit(rng), 140. + 60. * unit(rng), 3. + 12. * unit(rng), 3. + 12. * unit(rng),
                    0.3 + 0.4 * unit(rng)};
    CAPTURE(k, m.dark, m.bright, m.sigmaDark, m.sigmaBright, m.share);
    const vpImage<unsigned char> image = draw(rng, m);
    const vpPatternHistogram h = histogram(image);
    for (const vpPatternThreshold method :
         {vpPatternThreshold::Otsu, vpPatternThreshold::Isodata, vpPatternThreshold::MinimumError}) {
      CAPTURE(vpToString(method));
      const vpPatternThresholdResult r = vpFindThreshold(h, method);
      // Whatever the value itself, it lies between the classes and gives their means.
      CHECK(r.threshold > m.dark);
      CHECK(r.threshold < m.bright);
      CHECK(r.darkMean == Approx(m.dark).margin(3.));
      CHECK(r.brightMean == Approx(m.bright).margin(3.));
      CHECK(r.separability > 0.8);
      if (method != vpPatternThreshold::MinimumError) {
        vpImage<unsigned char> copy(image);
        const int peer = threshold(copy, method == vpPatternThreshold::Otsu);
        if (peer == 0) {
          continue; // ViSP's Isodata sometimes finds no fixed point
        }
        // Any value in the empty gap divides equally: compare the gap.
        long between = 0;
        for (int g = std::min(peer, r.threshold) + 1; g <= std::max(peer, r.threshold); ++g) {
          between += h[static_cast<std::size_t>(g)];
        }
        CAPTURE(peer, r.threshold);
        CHECK(between <= static_cast<long>(image.getSize()) / 100);
      }
    }
    // Exhaustive search of the criterion of Kittler and Illingworth, class by class.
    double least = std::numeric_limits<double>::infinity();
    int best = -1;
    for (int t = 0; t < 255; ++t) {
      double n[2] = {}, s[2] = {}, q[2] = {};
      for (int g = 0; g < 256; ++g) {
        const double c = h[static_cast<std::size_t>(g)];
        n[g > t] += c;
        s[g > t] += c * g;
        q[g > t] += c * g * g;
      }
      if (n[0] == 0. || n[1] == 0.) {
        continue;
      }
      double criterion = 0.;
      for (int c = 0; c < 2; ++c) {
        const double p = n[c] / (n[0] + n[1]), variance = q[c] / n[c] - std::pow(s[c] / n[c], 2) + 1. / 12.;
        criterion += p * std::log(variance) - 2. * p * std::log(p);
      }
      if (criterion < least - 1e-12) {
        least = criterion;
        best = t;
      }
    }
    CHECK(vpFindThreshold(h, vpPatternThreshold::MinimumError).threshold == best);
  }
}

TEST_CASE("a histogram that cannot be divided has no threshold", "[threshold]")
{
  vpPatternHistogram h{};
  CHECK(vpFindThreshold(h, vpPatternThreshold::Otsu).threshold == -1);
  h[255] = 100;
  CHECK(vpFindThreshold(h, vpPatternThreshold::Isodata).threshold == -1);
  h[255] = 0;
  h[0] = 7;
  CHECK(vpFindThreshold(h, vpPatternThreshold::MinimumError).threshold == -1);
  h[1] = 7; // two neighbouring values
  CHECK(vpFindThreshold(h, vpPatternThreshold::MinimumError).threshold == 0);
}

TEST_CASE("the median of the tracker is the value in the middle of any number of values", "[median]")
{
  auto rng = vpTestSupport::generator(860);
  CAPTURE(vpTestSupport::seed());
  std::vector<double> values = {1., 2., 3., 4., 5., 6., 7., 8., 9., 10.};
  CHECK(vpRobustMean::median(values) == 6.);
  for (int trial = 0; trial < 2000; ++trial) {
    values.resize(static_cast<std::size_t>(trial % 10 == 0 ? 71 + 2 * trial : 1 + trial % 70));
    const bool ties = trial % 3 == 0;
    const double outliers = trial % 4 == 0 ? 0.6 : 0.;
    std::uniform_real_distribution<double> between(-5., 5.), chance(0., 1.);
    for (double &value : values) {
      const double number = between(rng);
      value = chance(rng) < outliers ? 1e9 : ties ? std::round(number) : number;
    }
    if (trial % 7 == 0) { // in order, as deviations along a row may be
      std::sort(values.begin(), values.end());
    }
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    CAPTURE(values.size(), ties);
    CHECK(vpRobustMean::median(values) == sorted[sorted.size() / 2]);
  }
  values.clear();
  CHECK(vpRobustMean::median(values) == 0.);
}
