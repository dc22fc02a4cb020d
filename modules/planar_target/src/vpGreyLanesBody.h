/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Included by vpGreyLanes.cpp once per register width, each time in a namespace that defines lanes: not a template, because all
// of it must be compiled for the instruction set of the entry.

typedef float Lane __attribute__((vector_size(4 * lanes)));
typedef std::int32_t IntLane __attribute__((vector_size(4 * lanes)));
constexpr int wide = lanes / 2;
typedef double Wide __attribute__((vector_size(8 * wide)));

typedef float Row4 __attribute__((vector_size(16)));
typedef float Row8 __attribute__((vector_size(32)));
typedef float Row16 __attribute__((vector_size(64)));

// A register from memory and back: of four or eight numbers from \e a, of sixteen also from \e b.
VP_GREY_INLINE void loadRows(const float *a, const float *, Row4 &v) { std::memcpy(&v, a, sizeof(v)); }
VP_GREY_INLINE void loadRows(const float *a, const float *, Row8 &v) { std::memcpy(&v, a, sizeof(v)); }
VP_GREY_INLINE void loadRows(const float *a, const float *b, Row16 &v)
{
  Row8 first, second;
  std::memcpy(&first, a, sizeof(first));
  std::memcpy(&second, b, sizeof(second));
  v = __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
VP_GREY_INLINE void storeRows(float *a, float *, const Row4 &v) { std::memcpy(a, &v, sizeof(v)); }
VP_GREY_INLINE void storeRows(float *a, float *, const Row8 &v) { std::memcpy(a, &v, sizeof(v)); }
VP_GREY_INLINE void storeRows(float *a, float *b, const Row16 &v)
{
  const Row8 first = __builtin_shufflevector(v, v, 0, 1, 2, 3, 4, 5, 6, 7);
  const Row8 second = __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15);
  std::memcpy(a, &first, sizeof(first));
  std::memcpy(b, &second, sizeof(second));
}

// Sum of the quarters of a register.
VP_GREY_INLINE Row4 quarters(const Row4 &v) { return v; }
VP_GREY_INLINE Row4 quarters(const Row8 &v)
{
  return __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
}
VP_GREY_INLINE Row4 quarters(const Row16 &v)
{
  return quarters(__builtin_shufflevector(v, v, 0, 1, 2, 3, 4, 5, 6, 7) +
                  __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15));
}

// Four sums of four numbers each.
VP_GREY_INLINE Row4 fold(const Row4 &a, const Row4 &b, const Row4 &c, const Row4 &d)
{
  const Row4 ab = __builtin_shufflevector(a, b, 0, 4, 1, 5) + __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Row4 cd = __builtin_shufflevector(c, d, 0, 4, 1, 5) + __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
}

constexpr int chunk = 256; // numbers between two loops: they stay in the first cache

VP_GREY_INLINE Lane load(const float *p)
{
  Lane v;
  std::memcpy(&v, p, sizeof(v));
  return v;
}
VP_GREY_INLINE IntLane load(const std::int32_t *p)
{
  IntLane v;
  std::memcpy(&v, p, sizeof(v));
  return v;
}
VP_GREY_INLINE Wide load(const double *p)
{
  Wide v;
  std::memcpy(&v, p, sizeof(v));
  return v;
}
template <class Number, class Vector> VP_GREY_INLINE void store(Number *p, const Vector &v)
{
  std::memcpy(p, &v, sizeof(v));
}
VP_GREY_INLINE Lane filled(float v) { return Lane{} + v; }
VP_GREY_INLINE Lane real(const IntLane &v) { return __builtin_convertvector(v, Lane); }
VP_GREY_INLINE IntLane whole(const Lane &v) { return __builtin_convertvector(v, IntLane); }

VP_GREY_INLINE Lane ramp(int first)
{
  std::int32_t places[lanes];
  for (int l = 0; l < lanes; ++l) {
    places[l] = l;
  }
  return real(load(places) + first);
}

template <class Vector> VP_GREY_INLINE double total(const Vector &v)
{
  constexpr int n = sizeof(v) / sizeof(v[0]);
  double parts[n];
  for (int l = 0; l < n; ++l) {
    parts[l] = v[l];
  }
  for (int half = n / 2; half > 0; half /= 2) {
    for (int l = 0; l < half; ++l) {
      parts[l] += parts[l + half];
    }
  }
  return parts[0];
}

VP_GREY_INLINE int sampleFrame(const vpGreyFrameRow &row, int cols, float *values)
{
  const int padded = vpGreyPadded(cols);
  float fractionU[chunk], fractionV[chunk];
  std::int32_t places[chunk], pixels[chunk];
  IntLane inside = {};
  for (int begin = 0; begin < padded; begin += chunk) {
    const int count = std::min(chunk, padded - begin);
    for (int i = 0; i < count; i += lanes) {
      const Lane k = ramp(begin + i), depth = row.first[2] + k * row.next[2], inverse = 1.f / depth;
      const Lane x = inverse * (row.first[0] + k * row.next[0]), y = inverse * (row.first[1] + k * row.next[1]);
      const Lane distortion = 1.f + row.kud * (x * x + y * y);
      const Lane u = row.u0 + row.px * distortion * x, v = row.v0 + row.py * distortion * y;
      const IntLane ok = (inverse > 0.f) & (u >= 0.f) & (v >= 0.f) & (u < row.lastU) & (v < row.lastV) &
                         (k < static_cast<float>(cols));
      const IntLane iu = whole(ok ? u : Lane{}), iv = whole(ok ? v : Lane{});
      store(fractionU + i, ok ? u - real(iu) : filled(-1.f));
      store(fractionV + i, v - real(iv));
      store(places + i, iv * row.step + iu);
      inside -= ok;
    }
    for (int i = 0; i < count; ++i) {
      const unsigned char *const p = row.frame + places[i], *const q = p + row.step;
      const unsigned int upper = p[0] | p[1] << 8U, lower = q[0] | q[1] << 8U;
      pixels[i] = static_cast<std::int32_t>(upper | lower << 16U);
    }
    for (int i = 0; i < count; i += lanes) {
      const IntLane four = load(pixels + i);
      const Lane fu = load(fractionU + i), fv = load(fractionV + i);
      const Lane p0 = real(four & 255), p1 = real(four >> 8 & 255), q0 = real(four >> 16 & 255),
                 q1 = real(four >> 24 & 255);
      const Lane upper = p0 + fu * (p1 - p0), lower = q0 + fu * (q1 - q0);
      store(values + begin + i, fu < 0.f ? filled(-1.f) : upper + fv * (lower - upper));
    }
  }
  return static_cast<int>(total(inside));
}

VP_GREY_INLINE void sampleTexture(const vpGreyTextureRow &row, int count, float *values)
{
  const float *const t = row.toTexel;
  float fractionU[chunk], fractionV[chunk];
  std::int32_t places[chunk], upper[chunk], lower[chunk];
  const float yd = (row.row - row.v0) / row.py, inverseP = 1.f / row.px;
  for (int begin = 0; begin < count; begin += chunk) {
    const int n = std::min(chunk, count - begin);
    for (int i = 0; i < n; i += lanes) {
      const Lane xd = (ramp(begin + i) + (row.first - row.u0)) * inverseP;
      Lane x = xd, y = filled(yd);
      for (int k = 0; k < vpGreyTextureRow::undistortSteps && row.kud != 0.f; ++k) {
        const Lane scale = 1.f / (1.f + row.kud * (x * x + y * y));
        x = xd * scale;
        y = yd * scale;
      }
      const Lane inverse = 1.f / (t[6] * x + t[7] * y + t[8]);
      const Lane a = inverse * (t[0] * x + t[1] * y + t[2]), b = inverse * (t[3] * x + t[4] * y + t[5]);
      const Lane low = a > 0.f ? a : Lane{}, high = b > 0.f ? b : Lane{}; // also removes NaN
      const Lane u = low < row.lastU ? low : filled(row.lastU), v = high < row.lastV ? high : filled(row.lastV);
      const IntLane iu = whole(u), iv = whole(v);
      store(fractionU + i, u - real(iu));
      store(fractionV + i, v - real(iv));
      store(places + i, iv * row.step + iu);
    }
    for (int i = 0; i < n; ++i) {
      const std::uint16_t *const p = row.texels + places[i], *const q = p + row.step;
      upper[i] = static_cast<std::int32_t>(p[0] | static_cast<std::uint32_t>(p[1]) << 16U);
      lower[i] = static_cast<std::int32_t>(q[0] | static_cast<std::uint32_t>(q[1]) << 16U);
    }
    for (int i = 0; i < n; i += lanes) {
      const IntLane p = load(upper + i), q = load(lower + i);
      const Lane fu = load(fractionU + i);
      const Lane p0 = real(p & 65535), p1 = real(p >> 16 & 65535), q0 = real(q & 65535), q1 = real(q >> 16 & 65535);
      const Lane a = p0 + fu * (p1 - p0), b = q0 + fu * (q1 - q0);
      store(values + begin + i, (a + load(fractionV + i) * (b - a)) * (1.f / vpGreyTextureRow::scale));
    }
  }
}

struct Weighted {
  Lane weight, e;
};

// Tukey's weight of samples and their residuals; both 0 where a sample is rejected.
VP_GREY_INLINE Weighted weighted(const vpGreySamples &s, const Lane &value, const Lane &reference, const Lane &slope2)
{
  const Lane e = value - s.gain * reference - s.bias;
  const Lane fit = 1.f - e * e / (s.noise2 + s.shift2 * slope2);
  const IntLane taken = (value >= 0.f) & (fit > 0.f);
  return {taken ? fit * fit : Lane{}, taken ? e : Lane{}};
}

VP_GREY_INLINE void lightSums(const vpGreySamples &s, int count, double *sums)
{
  constexpr int most = 4096; // samples in one register: more would round
  for (int begin = 0; begin < count; begin += most) {
    Lane rr = {}, r = {}, one = {}, re = {}, e = {};
    for (int i = begin; i < std::min(count, begin + most); i += lanes) {
      const Lane reference = load(s.reference + i);
      const Weighted w = weighted(s, load(s.values + i), reference, load(s.slope2 + i));
      const Lane wr = w.weight * reference;
      rr += wr * reference;
      r += wr;
      one += w.weight;
      re += wr * w.e;
      e += w.weight * w.e;
    }
    sums[0] += total(rr);
    sums[1] += total(r);
    sums[2] += total(one);
    sums[3] += total(re);
    sums[4] += total(e);
  }
}

// 4x3 of the products: as many as fit into the registers with their factors.
VP_GREY_INLINE void products(const float (*col)[chunk], const float (*wcol)[chunk], int n, float (*sums)[lanes])
{
  Lane a[4][3];
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < 3; ++j) {
      a[k][j] = load(sums[12 * k + j]);
    }
  }
  for (int i = 0; i < n; i += lanes) {
    const Lane q0 = load(wcol[0] + i), q1 = load(wcol[1] + i), q2 = load(wcol[2] + i);
    for (int k = 0; k < 4; ++k) {
      const Lane p = load(col[k] + i);
      a[k][0] += p * q0;
      a[k][1] += p * q1;
      a[k][2] += p * q2;
    }
  }
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < 3; ++j) {
      store(sums[12 * k + j], a[k][j]);
    }
  }
}

VP_GREY_INLINE void normalSums(const vpGreySamples &s, const vpGreyGrid &grid, double *sums)
{
  constexpr int most = 8; // rows in one register: more would round
  float col[12][chunk], wcol[12][chunk], parts[144][lanes];
  for (int first = 0; first < grid.rows; first += most) {
    std::memset(parts, 0, sizeof(parts));
    for (int r = first; r < std::min(grid.rows, first + most); ++r) {
      const float y = grid.firstY + static_cast<float>(r) * grid.pitchY;
      for (int begin = 0; begin < grid.stride; begin += chunk) {
        const int n = std::min(chunk, grid.stride - begin);
        for (int i = 0; i < n; i += lanes) {
          const std::ptrdiff_t j = static_cast<std::ptrdiff_t>(r) * grid.stride + begin + i;
          const Lane dx = load(s.dx + j), dy = load(s.dy + j), reference = load(s.reference + j);
          const Lane x = grid.firstX + grid.pitchX * ramp(begin + i), g = dx * x + dy * y;
          const Weighted w = weighted(s, load(s.values + j), reference, load(s.slope2 + j));
          const Lane c[12] = {dx * x, dx * y, dx,        dy * x,      dy * y, dy,
                              -g * x, -g * y, reference, filled(1.f), w.e,    Lane{}};
          for (int k = 0; k < 12; ++k) {
            store(col[k] + i, c[k]);
            store(wcol[k] + i, w.weight * c[k]);
          }
        }
        for (int i = 0; i < 12; i += 4) {
          for (int j = i / 3 * 3; j < 12; j += 3) {
            products(col + i, wcol + j, n, parts + 12 * i + j);
          }
        }
      }
    }
    for (int k = 0; k < 144; ++k) {
      sums[k] += total(load(parts[k]));
    }
  }
}

VP_GREY_INLINE void moments(const vpGreySamples &s, int rows, std::ptrdiff_t step, vpGreyMoments &m)
{
  Lane inside = {}, count = {}, R = {}, I = {}, RR = {}, II = {}, RI = {};
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < 16; c += lanes) {
      const std::ptrdiff_t i = r * step + c;
      const Lane value = load(s.values + i), reference = load(s.reference + i);
      const Weighted w = weighted(s, value, reference, load(s.slope2 + i));
      const IntLane taken = w.weight > 0.f;
      const Lane a = taken ? reference - 128.f : Lane{}, b = taken ? value - 128.f : Lane{};
      inside += value >= 0.f ? filled(1.f) : Lane{};
      count += taken ? filled(1.f) : Lane{};
      R += a;
      I += b;
      RR += a * a;
      II += b * b;
      RI += a * b;
    }
  }
  m = {static_cast<float>(total(inside)), static_cast<float>(total(count)), static_cast<float>(total(R)),
       static_cast<float>(total(I)),      static_cast<float>(total(RR)),    static_cast<float>(total(II)),
       static_cast<float>(total(RI))};
}

VP_GREY_INLINE void filterRow(const float *left, const float *right, const float *const *kernels, int size, int count,
                              float *const *out)
{
  for (int c = 0; c < count; c += lanes) {
    Lane mean = {}, slope = {}, curvature = {};
    for (int i = 0; i < size; ++i) {
      const int step = (i + 1) / 2;
      const Lane a = load((i % 2 == 0 ? right : left) + c + step), b = load((i % 2 == 0 ? left : right) + c - step),
                 sum = a + b;
      mean += kernels[0][i] * sum;
      slope += kernels[1][i] * (a - b);
      curvature += kernels[2][i] * sum;
    }
    store(out[0] + c, mean);
    store(out[1] + c, slope);
    store(out[2] + c, curvature);
  }
}

VP_GREY_INLINE void filterColumns(const float *const *below, const float *const *above, const float *const *kernels,
                                  int size, int count, float *const *out)
{
  for (int c = 0; c < count; c += lanes) {
    Lane grey = {}, du = {}, dv = {}, dBlur = {};
    for (int i = 0; i < size; ++i) {
      const float *const *const lower = below + 3 * i, *const *const upper = above + 3 * i;
      const Lane a = load(lower[0] + c), b = load(upper[0] + c), sum = a + b;
      const float h = kernels[0][i];
      grey += h * sum;
      du += h * (load(lower[1] + c) + load(upper[1] + c));
      dv += kernels[1][i] * (a - b);
      dBlur += h * (load(lower[2] + c) + load(upper[2] + c)) + kernels[2][i] * sum;
    }
    store(out[0] + c, grey);
    store(out[1] + c, du);
    store(out[2] + c, dv);
    store(out[3] + c, dBlur);
  }
}

// A register of a block of 8x8: part of a row, a row, or two rows; i counts them.
constexpr int perBlock = 64 / lanes;
VP_GREY_INLINE Lane loadPart(const vpGreyPlane &plane, int row, int col, int i)
{
  const float *const from = plane.at(row + i * lanes / 8, col + i * lanes % 8);
  Lane v;
  loadRows(from, from + plane.step, v);
  return v;
}
VP_GREY_INLINE void storePart(const vpGreyPlane &plane, int row, int col, int i, const Lane &v)
{
  float *const to = plane.at(row + i * lanes / 8, col + i * lanes % 8);
  storeRows(to, to + plane.step, v);
}

VP_GREY_INLINE void residuals(const vpGreyPixels &pixels, const vpGreyBlock *blocks, std::size_t count,
                              const double *change, float gain, float bias, float beta)
{
  for (std::size_t k = 0; k < count; ++k) {
    const vpGreyBlock &b = blocks[k];
    double shift[2] = {0., 0.};
    for (int j = 0; j < 6; ++j) {
      shift[0] += b.motion[0][j] * change[j];
      shift[1] += b.motion[1][j] * change[j];
    }
    const float su = static_cast<float>(shift[0]), sv = static_cast<float>(shift[1]);
    for (int i = 0; i < perBlock; ++i) {
      const auto at = [&](const vpGreyPlane &plane) { return loadPart(plane, b.row, b.col, i); };
      const Lane grey = at(pixels.grey) - su * at(pixels.du) - sv * at(pixels.dv) + beta * at(pixels.dBlur);
      storePart(pixels.residuals, b.row, b.col, i, at(pixels.frame) - bias - gain * grey);
    }
  }
}

template <vpGreyWeights::Kind kind>
VP_GREY_INLINE void sumsOfBlock(const vpGreyPixels &pixels, const vpGreyBlock &b, const vpGreyWeights &weights,
                                float *out)
{
  Lane sums[20] = {};
  const float inverseGain = 1.f / weights.gain;
  for (int part = 0; part < perBlock; ++part) {
    const auto at = [&](const vpGreyPlane &plane) { return loadPart(plane, b.row, b.col, part); };
    const Lane e = at(pixels.residuals), du = at(pixels.du), dv = at(pixels.dv);
    const Lane ratio = e * e / (weights.noise2 + weights.shift2 * (du * du + dv * dv)),
               misfit = ratio < 1.f ? ratio : filled(1.f);
    Lane w = at(pixels.open) * (1.f - misfit);
    w *= kind == vpGreyWeights::Kind::Derivative ? 1.f - 5.f * misfit : 1.f - misfit;
    if (kind == vpGreyWeights::Kind::Score) {
      w *= w * e * e;
    }
    const Lane basis[5] = {du, dv, (at(pixels.frame) - weights.bias - e) * inverseGain, filled(1.f), at(pixels.dBlur)};
    int k = 0;
    for (int i = 0; i < 5; ++i) {
      const Lane weighted = w * basis[i];
      for (int j = i; j < 5; ++j) {
        sums[k++] += weighted * basis[j];
      }
      sums[k++] += weighted * e;
    }
  }
  for (int k = 0; k < 20; k += 4) {
    store(out + k, fold(quarters(sums[k]), quarters(sums[k + 1]), quarters(sums[k + 2]), quarters(sums[k + 3])));
  }
  store(out + 20, Row4{});
}

VP_GREY_INLINE void blockSums(const vpGreyPixels &pixels, const vpGreyBlock *blocks, std::size_t count,
                              vpGreyWeights::Kind kind, const vpGreyWeights &weights, float *sums)
{
  using Kind = vpGreyWeights::Kind;
  for (std::size_t k = 0; k < count; ++k) {
    switch (kind) {
    case Kind::Estimate:
      sumsOfBlock<Kind::Estimate>(pixels, blocks[k], weights, sums + 24 * k);
      break;
    case Kind::Derivative:
      sumsOfBlock<Kind::Derivative>(pixels, blocks[k], weights, sums + 24 * k);
      break;
    case Kind::Score:
      sumsOfBlock<Kind::Score>(pixels, blocks[k], weights, sums + 24 * k);
      break;
    }
  }
}

VP_GREY_INLINE void assemble(const vpGreyBlock *blocks, const float *sums, std::size_t count, double gain,
                             vpGreyNormal &normal)
{
  Wide pose[6][8 / wide] = {}, light[3][8 / wide] = {}, right[8 / wide] = {};
  double all[24] = {};
  for (std::size_t k = 0; k < count; ++k) {
    const double(*const m)[8] = blocks[k].motion;
    const float *const s = sums + 24 * k;
    for (int i = 0; i < 24; ++i) {
      all[i] += s[i];
    }
    for (int h = 0; h < 8 / wide; ++h) {
      const Wide u = load(m[0] + h * wide), v = load(m[1] + h * wide);
      const Wide a = static_cast<double>(s[0]) * u + static_cast<double>(s[1]) * v,
                 b = static_cast<double>(s[1]) * u + static_cast<double>(s[6]) * v;
      for (int i = 0; i < 6; ++i) {
        pose[i][h] += m[0][i] * a + m[1][i] * b;
      }
      for (int i = 0; i < 3; ++i) {
        light[i][h] += static_cast<double>(s[2 + i]) * u + static_cast<double>(s[7 + i]) * v;
      }
      right[h] += static_cast<double>(s[5]) * u + static_cast<double>(s[10]) * v;
    }
  }
  for (int h = 0; h < 8 / wide; ++h) {
    for (int i = 0; i < 6; ++i) {
      store(normal.pose[i] + h * wide, gain * gain * pose[i][h]);
    }
    for (int i = 0; i < 3; ++i) {
      store(normal.light[i] + h * wide, -gain * light[i][h]);
    }
    store(normal.right + h * wide, -gain * right[h]);
  }
  std::memcpy(normal.sums, all, sizeof(all));
}

VP_GREY_INLINE void misfit(const float *e, const float *du, const float *dv, int begin, int end, int count,
                           const vpGreyWeights &variance, float cap, float limit, float *out)
{
  for (int c = 0; c < count; c += lanes) {
    const Lane k = ramp(c), u = load(du + c), v = load(dv + c), r = load(e + c);
    const Lane square = r * r / (variance.noise2 + variance.shift2 * (u * u + v * v)),
               capped = square < cap ? square : filled(cap);
    const IntLane on = (k >= static_cast<float>(begin)) & (k < static_cast<float>(end));
    store(out + c, on ? capped - limit : Lane{});
  }
}
