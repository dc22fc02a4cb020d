/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The loops over grey values by the version for each kind of processor, of which a machine uses only one, against plain sums in
// double precision.
#include "../src/vpGreyLanes.cpp" // not exported

#include "vpCatch.h"
#include "vpGreyMedian.h"

#include <visp3/direct_core/vpQuantile.h>

#include <array>
#include <cmath>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace
{
using vpTestSupport::uniform;
using Floats = std::vector<float>;

std::vector<const vpGreyLanes *> versionsOfThisMachine()
{
  std::vector<const vpGreyLanes *> versions = {&baseline::table, &chooseLanes()};
#ifdef VP_GREY_VERSIONS
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    versions.push_back(&avx2::table);
  }
#endif
  return versions;
}

Floats numbers(std::mt19937_64 &rng, std::size_t n, double low, double high)
{
  Floats v(n);
  for (float &x : v) {
    x = static_cast<float>(uniform(rng, low, high));
  }
  return v;
}

// Near \e wanted, relative to \e size, the sum of what was added.
bool near(double value, double wanted, double size) { return std::abs(value - wanted) <= 2e-5 * size + 1e-6; }

struct Samples {
  explicit Samples(std::mt19937_64 &rng)
    : cols(static_cast<int>(uniform(rng, 20., 300.))), rows(static_cast<int>(uniform(rng, 1., 20.)))
  {
    const auto n = static_cast<std::size_t>(vpGreyPadded(cols) * rows);
    reference = numbers(rng, n, 0., 255.);
    dx = numbers(rng, n, -300., 300.);
    dy = numbers(rng, n, -300., 300.);
    slope2 = numbers(rng, n, 0., 400.);
    values.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const bool seen = static_cast<int>(i) % vpGreyPadded(cols) < cols && uniform(rng, 0., 1.) < 0.8;
      values[i] = seen ? std::max(0.f, 0.9f * reference[i] + 5.f + static_cast<float>(uniform(rng, -20., 20.))) : -1.f;
    }
    all = {values.data(), reference.data(), dx.data(), dy.data(), slope2.data(), 0.9f, 5.f, 150.f, 0.3f};
  }
  [[nodiscard]] double residual(std::size_t i) const { return values[i] - 0.9 * reference[i] - 5.; }
  [[nodiscard]] double weight(std::size_t i) const
  {
    const double fit = 1. - residual(i) * residual(i) / (150. + 0.3 * slope2[i]);
    return values[i] >= 0.f && fit > 0. ? fit * fit : 0.;
  }
  int cols, rows;
  Floats values, reference, dx, dy, slope2;
  vpGreySamples all;
};
} // namespace

TEST_CASE("samples of a frame are bilinear inside it and marked outside, by every version", "[grey_lanes]")
{
  constexpr int cols = 61, rows = 47;
  for (int problem = 0; problem < vpTestSupport::longer(60); ++problem) {
    auto rng = vpTestSupport::generator(problem);
    std::vector<unsigned char> frame(cols * rows);
    for (unsigned char &p : frame) {
      p = static_cast<unsigned char>(rng());
    }
    vpGreyFrameRow row = {
        frame.data(), cols, cols - 1, rows - 1, 50.f, 52.f, 30.f, 23.f, problem % 2 == 0 ? 0.f : 0.1f};
    for (int k = 0; k < 3; ++k) {
      row.first[k] = static_cast<float>(uniform(rng, -0.7, 0.7)) + (k == 2 ? 1.f : 0.f);
      row.next[k] = static_cast<float>(uniform(rng, -0.02, 0.02));
    }
    const int n = static_cast<int>(uniform(rng, 1., 300.));
    for (const vpGreyLanes *version : versionsOfThisMachine()) {
      Floats values(static_cast<std::size_t>(vpGreyPadded(n)), 7.f);
      const int inside = version->sampleFrame(row, n, values.data());
      int counted = 0;
      for (int c = 0; c < vpGreyPadded(n); ++c) {
        const double Z = row.first[2] + c * double(row.next[2]), x = (row.first[0] + c * double(row.next[0])) / Z,
                     y = (row.first[1] + c * double(row.next[1])) / Z, d = 1. + row.kud * (x * x + y * y);
        const double u = row.u0 + row.px * d * x, v = row.v0 + row.py * d * y;
        const float value = values[static_cast<std::size_t>(c)];
        CAPTURE(problem, version->name, c, u, v, Z);
        counted += value >= 0.f ? 1 : 0;
        if (c >= n) {
          REQUIRE(value == -1.f);
          continue;
        }
        if (std::abs(Z) < 1e-3 || std::abs(u) < 1e-2 || std::abs(v) < 1e-2 || std::abs(u - row.lastU) < 1e-2 ||
            std::abs(v - row.lastV) < 1e-2) {
          continue; // rounding decides
        }
        const bool in = Z > 0. && u >= 0. && v >= 0. && u < row.lastU && v < row.lastV;
        REQUIRE((value >= 0.f) == in);
        if (in) {
          const int iu = static_cast<int>(u), iv = static_cast<int>(v);
          const unsigned char *const p = &frame[static_cast<std::size_t>(iv * cols + iu)];
          const double fu = u - iu, fv = v - iv;
          const double wanted =
              (1. - fv) * ((1. - fu) * p[0] + fu * p[1]) + fv * ((1. - fu) * p[cols] + fu * p[cols + 1]);
          REQUIRE(std::abs(value - wanted) < 0.1);
        }
      }
      REQUIRE(inside == counted);
    }
  }
}

TEST_CASE("a position that is not a number is outside the frame, by every version", "[grey_lanes]")
{
  const std::vector<unsigned char> frame(32 * 32, 100);
  vpGreyFrameRow row = {frame.data(), 32, 31.f, 31.f, 50.f, 50.f, 15.f, 15.f, 0.f};
  for (const vpGreyLanes *version : versionsOfThisMachine()) {
    for (const float depth : {NAN, 0.f, -1.f}) {
      row.first[2] = depth;
      Floats values(vpGreyMostLanes, 7.f);
      CAPTURE(version->name, depth);
      CHECK(version->sampleFrame(row, vpGreyMostLanes, values.data()) == 0);
      CHECK(values == Floats(vpGreyMostLanes, -1.f));
    }
  }
}

TEST_CASE("sums over samples agree with sums in double precision, by every version", "[grey_lanes]")
{
  for (int problem = 0; problem < vpTestSupport::longer(40); ++problem) {
    auto rng = vpTestSupport::generator(problem);
    const Samples s(rng);
    const int stride = vpGreyPadded(s.cols);
    const vpGreyGrid grid = {s.rows, stride, -1.f, 0.013f, 0.3f, 0.017f};
    std::array<double, 5> light{}, lightSize{};
    std::array<double, 144> normal{}, normalSize{};
    for (std::size_t i = 0; i < s.values.size(); ++i) {
      const double w = s.weight(i), e = w > 0. ? s.residual(i) : 0., R = s.reference[i];
      const std::array<double, 5> products = {w * R * R, w * R, w, w * R * e, w * e};
      for (std::size_t k = 0; k < 5; ++k) {
        light[k] += products[k];
        lightSize[k] += std::abs(products[k]);
      }
      const int r = static_cast<int>(i) / stride, c = static_cast<int>(i) % stride;
      const double x = grid.firstX + c * double(grid.pitchX), y = grid.firstY + r * double(grid.pitchY);
      const double dx = s.dx[i], dy = s.dy[i], g = dx * x + dy * y;
      const std::array<double, 12> column = {dx * x, dx * y, dx, dy * x, dy * y, dy, -g * x, -g * y, R, 1., e, 0.};
      for (std::size_t k = 0; k < 144; ++k) {
        normal[k] += w * column[k / 12] * column[k % 12];
        normalSize[k] += std::abs(w * column[k / 12] * column[k % 12]);
      }
    }
    for (const vpGreyLanes *version : versionsOfThisMachine()) {
      CAPTURE(problem, version->name);
      std::array<double, 5> sums{};
      version->lightSums(s.all, static_cast<int>(s.values.size()), sums.data());
      for (std::size_t k = 0; k < 5; ++k) {
        REQUIRE(near(sums[k], light[k], lightSize[k]));
      }
      std::array<double, 144> products{};
      version->normalSums(s.all, grid, products.data());
      for (std::size_t k = 0; k < 144; ++k) {
        REQUIRE((k / 12 > k % 12 || near(products[k], normal[k], normalSize[k])));
      }
      vpGreyMoments m;
      version->moments(s.all, s.rows, stride, m);
      double inside = 0., count = 0., RI = 0., size = 0.;
      for (int i = 0; i < 16 * s.rows; ++i) {
        const auto k = static_cast<std::size_t>(i / 16 * stride + i % 16);
        inside += s.values[k] >= 0.f ? 1. : 0.;
        count += s.weight(k) > 0. ? 1. : 0.;
        RI += s.weight(k) > 0. ? (s.reference[k] - 128.) * (s.values[k] - 128.) : 0.;
        size += 128. * 128.;
      }
      REQUIRE(m.inside == inside);
      REQUIRE(m.count == count);
      REQUIRE(near(m.RI, RI, size));
    }
  }
}

TEST_CASE("residuals, sums and normal equations of blocks agree with double precision, by every version",
          "[grey_lanes]")
{
  constexpr int step = 64, rows = 24;
  for (int problem = 0; problem < vpTestSupport::longer(40); ++problem) {
    auto rng = vpTestSupport::generator(problem);
    Floats grey = numbers(rng, step * rows, 0., 255.), du = numbers(rng, step * rows, -40., 40.),
           dv = numbers(rng, step * rows, -40., 40.), dBlur = numbers(rng, step * rows, -9., 9.),
           frame = numbers(rng, step * rows, 0., 255.), open = numbers(rng, step * rows, 0., 2.);
    for (float &o : open) {
      o = std::floor(o);
    }
    std::vector<vpGreyBlock> blocks = {{0, 0, {}}, {8, 24, {}}, {16, 56, {}}};
    std::array<double, 9> change{};
    for (double &d : change) {
      d = uniform(rng, -0.1, 0.1);
    }
    for (vpGreyBlock &b : blocks) {
      for (int k = 0; k < 6; ++k) {
        b.motion[0][k] = uniform(rng, -1., 1.);
        b.motion[1][k] = uniform(rng, -1., 1.);
      }
    }
    const float gain = 0.8f, bias = 4.f, beta = static_cast<float>(change[8]);
    for (const vpGreyLanes *version : versionsOfThisMachine()) {
      Floats residuals(step * rows, 0.f);
      const vpGreyPixels pixels = {{frame.data(), step}, {open.data(), step}, {residuals.data(), step},
                                   {grey.data(), step},  {du.data(), step},   {dv.data(), step},
                                   {dBlur.data(), step}};
      version->residuals(pixels, blocks.data(), blocks.size(), change.data(), gain, bias, beta);
      for (int kind = 0; kind < 3; ++kind) {
        const vpGreyWeights weights = {gain, bias, 8000.f, 3.f};
        Floats sums(24 * blocks.size(), 7.f);
        version->blockSums(pixels, blocks.data(), blocks.size(), static_cast<vpGreyWeights::Kind>(kind), weights,
                           sums.data());
        vpGreyNormal normal;
        version->assemble(blocks.data(), sums.data(), blocks.size(), gain, normal);
        double N[9][9] = {}, sizes[9][9] = {}, right[9] = {}, rightSizes[9] = {};
        for (const vpGreyBlock &b : blocks) {
          double shift[2] = {};
          for (int k = 0; k < 6; ++k) {
            shift[0] += b.motion[0][k] * change[static_cast<std::size_t>(k)];
            shift[1] += b.motion[1][k] * change[static_cast<std::size_t>(k)];
          }
          for (int i = 0; i < 64; ++i) {
            const auto p = static_cast<std::size_t>((b.row + i / 8) * step + b.col + i % 8);
            const double predicted = grey[p] - shift[0] * du[p] - shift[1] * dv[p] + beta * dBlur[p];
            const double e = frame[p] - bias - gain * predicted;
            CAPTURE(problem, version->name, b.row, b.col, i);
            REQUIRE(std::abs(residuals[p] - e) < 1e-3);
            const double misfit = std::min(1., e * e / (8000. + 3. * (du[p] * du[p] + dv[p] * dv[p])));
            double w = open[p] * (1. - misfit) * (kind == 1 ? 1. - 5. * misfit : 1. - misfit);
            w *= kind == 2 ? w * e * e : 1.;
            double J[9];
            for (int k = 0; k < 6; ++k) {
              J[k] = -gain * (b.motion[0][k] * du[p] + b.motion[1][k] * dv[p]);
            }
            J[6] = predicted;
            J[7] = 1.;
            J[8] = dBlur[p];
            for (int j = 0; j < 9; ++j) {
              right[j] += w * J[j] * e;
              rightSizes[j] += std::abs(w * J[j] * e);
              for (int k = 0; k < 9; ++k) {
                N[j][k] += w * J[j] * J[k];
                sizes[j][k] += std::abs(w * J[j] * J[k]) + std::abs(w) * 1600.;
              }
            }
          }
        }
        CAPTURE(problem, version->name, kind);
        constexpr int lightSum[3][3] = {{11, 12, 13}, {12, 15, 16}, {13, 16, 18}}, lightRight[3] = {14, 17, 19};
        for (int j = 0; j < 6; ++j) {
          REQUIRE(near(normal.right[j], right[j], 3. * rightSizes[j]));
          for (int k = 0; k < 6; ++k) {
            REQUIRE(near(normal.pose[j][k], N[j][k], sizes[j][k]));
          }
        }
        for (int j = 0; j < 3; ++j) {
          REQUIRE(near(normal.sums[lightRight[j]], right[6 + j], 3. * rightSizes[6 + j]));
          for (int k = 0; k < 3; ++k) {
            REQUIRE(near(normal.sums[lightSum[j][k]], N[6 + j][6 + k], sizes[6 + j][6 + k]));
          }
          for (int k = 0; k < 6; ++k) {
            REQUIRE(near(normal.light[j][k], N[6 + j][k], sizes[6 + j][k]));
          }
        }
      }
    }
  }
}

TEST_CASE("the median by counting is that of the sorted values", "[grey_lanes]")
{
  for (int problem = 0; problem < vpTestSupport::longer(50); ++problem) {
    auto rng = vpTestSupport::generator(problem);
    vpGreyMedian median(16);
    median.clear();
    std::vector<double> values;
    for (int i = 0; i < 999; ++i) {
      values.push_back(std::abs(uniform(rng, -20., 200.)));
      median.add(static_cast<float>(values.back()));
    }
    CAPTURE(problem);
    REQUIRE(std::abs(median.value() - vpMedian(values)) < 1. / 16.);
  }
  vpGreyMedian median(16);
  median.clear();
  CHECK(median.value() == 0.);
  median.add(NAN);
  CHECK(median.value() >= 256.);
}

TEST_CASE("textures are bilinear between texels and repeated beyond, by every version", "[grey_lanes]")
{
  constexpr int cols = 40, rows = 30;
  for (int problem = 0; problem < vpTestSupport::longer(60); ++problem) {
    auto rng = vpTestSupport::generator(problem);
    std::vector<std::uint16_t> texels(cols * rows);
    for (std::uint16_t &t : texels) {
      t = static_cast<std::uint16_t>(rng() % 65281);
    }
    vpGreyTextureRow row = {texels.data(), cols, cols - 1.001f, rows - 1.001f, {},    50.f,
                            52.f,          20.f, 15.f,          0.f,           -5.3f, 9.7f};
    const double H[9] = {45., 3., 19., -4., 44., 14., uniform(rng, -0.2, 0.2), uniform(rng, -0.2, 0.2), 1.};
    std::copy_n(H, 9, row.toTexel);
    for (const vpGreyLanes *version : versionsOfThisMachine()) {
      Floats values(64);
      version->sampleTexture(row, 64, values.data());
      for (int i = 0; i < 64; ++i) {
        const double x = (row.first + i - row.u0) / row.px, y = (row.row - row.v0) / row.py,
                     z = H[6] * x + H[7] * y + 1.;
        const double u = std::clamp((H[0] * x + H[1] * y + H[2]) / z, 0., cols - 1.001);
        const double v = std::clamp((H[3] * x + H[4] * y + H[5]) / z, 0., rows - 1.001);
        const int iu = static_cast<int>(u), iv = static_cast<int>(v);
        const std::uint16_t *const p = &texels[static_cast<std::size_t>(iv * cols + iu)];
        const double fu = u - iu, fv = v - iv;
        const double wanted =
            (1. - fv) * ((1. - fu) * p[0] + fu * p[1]) + fv * ((1. - fu) * p[cols] + fu * p[cols + 1]);
        CAPTURE(problem, version->name, i, u, v);
        REQUIRE(std::abs(values[static_cast<std::size_t>(i)] - wanted / 256.) < 0.02);
      }
    }
  }
}

TEST_CASE("filters along rows and columns and misfits agree with double precision, by every version", "[grey_lanes]")
{
  constexpr int size = 5, count = 37, room = 80, halo = 4;
  auto rng = vpTestSupport::generator();
  const Floats left = numbers(rng, room, 0., 255.), right = numbers(rng, room, 0., 255.);
  std::vector<Floats> kernels, lines;
  for (int i = 0; i < 3; ++i) {
    kernels.push_back(numbers(rng, size, -1., 1.));
  }
  for (int i = 0; i < 6 * size; ++i) {
    lines.push_back(numbers(rng, room, 0., 255.));
  }
  const float *const parts[3] = {kernels[0].data(), kernels[1].data(), kernels[2].data()};
  const float *below[3 * size], *above[3 * size];
  for (int i = 0; i < 3 * size; ++i) {
    below[i] = lines[static_cast<std::size_t>(i)].data();
    above[i] = lines[static_cast<std::size_t>(3 * size + i)].data();
  }
  for (const vpGreyLanes *version : versionsOfThisMachine()) {
    CAPTURE(version->name);
    std::array<Floats, 4> out;
    float *to[4];
    for (std::size_t k = 0; k < 4; ++k) {
      out[k].resize(room);
      to[k] = out[k].data();
    }
    version->filterRow(left.data() + halo, right.data() + halo, parts, size, count, to);
    for (int c = 0; c < count; ++c) {
      double sums[3] = {};
      for (int i = 0; i < size; ++i) {
        const int s = (i + 1) / 2, at = halo + c;
        const double a = i % 2 == 0 ? right[static_cast<std::size_t>(at + s)] : left[static_cast<std::size_t>(at + s)];
        const double b = i % 2 == 0 ? left[static_cast<std::size_t>(at - s)] : right[static_cast<std::size_t>(at - s)];
        sums[0] += parts[0][i] * (a + b);
        sums[1] += parts[1][i] * (a - b);
        sums[2] += parts[2][i] * (a + b);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        REQUIRE(near(out[k][static_cast<std::size_t>(c)], sums[k], 1000.));
      }
    }
    version->filterColumns(below, above, parts, size, count, to);
    for (int c = 0; c < count; ++c) {
      double sums[4] = {};
      for (int i = 0; i < size; ++i) {
        const double a = below[3 * i][c], b = above[3 * i][c];
        sums[0] += parts[0][i] * (a + b);
        sums[1] += parts[0][i] * (double(below[3 * i + 1][c]) + above[3 * i + 1][c]);
        sums[2] += parts[1][i] * (a - b);
        sums[3] += parts[0][i] * (double(below[3 * i + 2][c]) + above[3 * i + 2][c]) + parts[2][i] * (a + b);
      }
      for (std::size_t k = 0; k < 4; ++k) {
        REQUIRE(near(out[k][static_cast<std::size_t>(c)], sums[k], 2000.));
      }
    }
    version->misfit(left.data(), below[0], below[1], 3, 20, count, {1.f, 0.f, 100.f, 0.5f}, 12.f, 2.f, to[0]);
    for (int c = 0; c < count; ++c) {
      const double u = below[0][c], v = below[1][c], e = left[static_cast<std::size_t>(c)];
      const double wanted = c >= 3 && c < 20 ? std::min(12., e * e / (100. + 0.5 * (u * u + v * v))) - 2. : 0.;
      REQUIRE(near(out[0][static_cast<std::size_t>(c)], wanted, 12.));
    }
  }
}
