/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Included once for double by vpSegmentKernel.h and once per vector width by vpEdgeLanes.cpp, each time in a namespace that declares
// root() of its vectors.

template <class T> struct V3 {
  T x, y, z;
};
//! Nearest points, a on the segment and b on the other body, and their distance.
template <class T> struct Nearest {
  T distance;
  V3<T> a, b;
};

template <class T> VP_KERNEL_INLINE V3<T> operator+(const V3<T> &a, const V3<T> &b)
{
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T> VP_KERNEL_INLINE V3<T> operator-(const V3<T> &a, const V3<T> &b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T> VP_KERNEL_INLINE V3<T> operator*(const T &k, const V3<T> &a) { return {k * a.x, k * a.y, k * a.z}; }
template <class T> VP_KERNEL_INLINE T dot(const V3<T> &a, const V3<T> &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <class T> VP_KERNEL_INLINE V3<T> cross(const V3<T> &a, const V3<T> &b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T> VP_KERNEL_INLINE T smaller(const T &a, const T &b) { return a < b ? a : b; }
template <class T> VP_KERNEL_INLINE T larger(const T &a, const T &b) { return a > b ? a : b; }
template <class T> VP_KERNEL_INLINE T clamp(const T &v, const T &low, const T &high)
{
  return smaller(larger(v, low), high);
}
VP_KERNEL_INLINE double root(const double &v) { return std::sqrt(v); }
template <class T> VP_KERNEL_INLINE T constant(double v) { return T{} + v; }
//! a / b, or 0 where b is 0: for segments that are points.
template <class T> VP_KERNEL_INLINE T ratio(const T &a, const T &b)
{
  const T zero = constant<T>(0.), one = constant<T>(1.);
  return b != zero ? a / (b != zero ? b : one) : zero;
}
template <class T> VP_KERNEL_INLINE V3<T> choose(const V3<T> &a, const V3<T> &b, const T &da, const T &db)
{
  return {da <= db ? a.x : b.x, da <= db ? a.y : b.y, da <= db ? a.z : b.z};
}

template <class T> VP_KERNEL_INLINE Nearest<T> toPoint(const V3<T> &from, const V3<T> &to, const V3<T> &point)
{
  const V3<T> d = to - from;
  const T t = clamp(ratio(dot(point - from, d), dot(d, d)), constant<T>(0.), constant<T>(1.));
  const V3<T> a = from + t * d, gap = a - point;
  return {root(dot(gap, gap)), a, point};
}

//! Keeps the nearer of the best result and the points at s and t.
template <class T>
VP_KERNEL_INLINE void offer(const V3<T> &p, const V3<T> &d, const V3<T> &q, const V3<T> &e, const T &s, const T &t,
                            T &squared, V3<T> &a, V3<T> &b)
{
  const V3<T> x = p + s * d, y = q + t * e, gap = x - y;
  const T now = dot(gap, gap);
  a = choose(a, x, squared, now);
  b = choose(b, y, squared, now);
  squared = smaller(squared, now);
}

/*
 * Minimum of five: inside both segments, and each of the four ends. Inside, s = ((q - p) x e) . n / n . n with n = d x
 * e keeps its accuracy for nearly parallel segments, where the usual d.d e.e - (d.e)^2 suffers from cancellation.
 */
template <class T>
VP_KERNEL_INLINE Nearest<T> toSegment(const V3<T> &p, const V3<T> &pEnd, const V3<T> &q, const V3<T> &qEnd)
{
  const T zero = constant<T>(0.), one = constant<T>(1.);
  const V3<T> d = pEnd - p, e = qEnd - q, r = p - q, n = cross(d, e);
  const T dd = dot(d, d), ee = dot(e, e), de = dot(d, e), rd = dot(r, d), re = dot(r, e);
  T s = clamp(ratio(dot(cross(q - p, e), n), dot(n, n)), zero, one);
  T t = clamp(ratio(s * de + re, ee), zero, one);
  s = clamp(ratio(t * de - rd, dd), zero, one);
  V3<T> a = p + s * d, b = q + t * e;
  const V3<T> gap = a - b;
  T squared = dot(gap, gap);
  offer(p, d, q, e, zero, clamp(ratio(re, ee), zero, one), squared, a, b);
  offer(p, d, q, e, one, clamp(ratio(re + de, ee), zero, one), squared, a, b);
  offer(p, d, q, e, clamp(ratio(zero - rd, dd), zero, one), zero, squared, a, b);
  offer(p, d, q, e, clamp(ratio(de - rd, dd), zero, one), one, squared, a, b);
  return {root(squared), a, b};
}

template <class T> VP_KERNEL_INLINE T excess(const T &x, const T &half) { return x - clamp(x, T{} - half, half); }

//! Narrows the bracket [low, high] of the root of a rising function by its value g at t.
template <class T> VP_KERNEL_INLINE void narrow(const T &t, const T &g, T &low, T &gLow, T &high, T &gHigh)
{
  const T zero = constant<T>(0.);
  const auto left = (g <= zero) & (t > low), right = (g >= zero) & (t < high);
  low = left ? t : low;
  gLow = left ? g : gLow;
  high = right ? t : high;
  gHigh = right ? g : gHigh;
}

//! Half the derivative of the squared distance from the box, along the segment.
template <class T> VP_KERNEL_INLINE T boxSlope(const V3<T> &p, const V3<T> &d, const V3<T> &half, const T &t)
{
  return d.x * excess(p.x + t * d.x, half.x) + d.y * excess(p.y + t * d.y, half.y) +
         d.z * excess(p.z + t * d.z, half.z);
}

/*
 * Box centred at the origin. The squared distance is convex and piecewise quadratic in t, its slope increases piecewise
 * linearly with at most six kinks: the two kinks enclosing the root give it exactly.
 */
template <class T> VP_KERNEL_INLINE Nearest<T> toBox(const V3<T> &from, const V3<T> &to, const V3<T> &half)
{
  const T zero = constant<T>(0.), one = constant<T>(1.);
  const V3<T> d = to - from;
  T low = zero, high = one, gLow = boxSlope(from, d, half, low), gHigh = boxSlope(from, d, half, high);
  const T kinks[6] = {ratio(half.x - from.x, d.x), ratio(T{} - half.x - from.x, d.x),
                      ratio(half.y - from.y, d.y), ratio(T{} - half.y - from.y, d.y),
                      ratio(half.z - from.z, d.z), ratio(T{} - half.z - from.z, d.z)};
  for (const T &kink : kinks) {
    const T t = clamp(kink, zero, one);
    narrow(t, boxSlope(from, d, half, t), low, gLow, high, gHigh);
  }
  const T between = low + (high - low) * ratio(T{} - gLow, gHigh - gLow);
  const T t = gLow >= zero ? low : (gHigh <= zero ? high : clamp(between, low, high));
  const V3<T> a = from + t * d;
  const V3<T> b = {clamp(a.x, T{} - half.x, half.x), clamp(a.y, T{} - half.y, half.y),
                   clamp(a.z, T{} - half.z, half.z)};
  const V3<T> gap = a - b;
  return {root(dot(gap, gap)), a, b};
}

//! Half the slope of the squared distance from a cylinder about z, and that distance.
template <class T>
VP_KERNEL_INLINE T cylinderSlope(const V3<T> &p, const V3<T> &d, const T &radius, const T &half, const T &t, T &squared)
{
  const T zero = constant<T>(0.), x = p.x + t * d.x, y = p.y + t * d.y, z = p.z + t * d.z, rho = root(x * x + y * y);
  const T out = larger(rho - radius, zero), over = excess(z, half);
  squared = out * out + over * over;
  return ratio(out * (x * d.x + y * d.y), rho) + d.z * over;
}

//! One configuration is solved completely; eight take as many steps as nearly all of them need.
template <class T> constexpr int rootSteps() { return 18; }
template <> constexpr int rootSteps<double>() { return 50; } // The last one is not a bisection.
//! The squared distance f is convex: at a slope 2 g it exceeds its minimum by at most 2 |g| (high - low).
template <class T> VP_KERNEL_INLINE bool isClosed(const T &, const T &, const T &) { return false; }
template <> VP_KERNEL_INLINE bool isClosed(const double &width, const double &g, const double &squared)
{
  return std::fabs(g) * width <= 1e-12 * squared + 1e-26;
}

/*
 * Solid cylinder about z: the slope has kinks where the segment crosses the planes of the caps and the lateral surface;
 * in between it is smooth, and a bracketed secant (Illinois) with bisections finds the root. An error e of t changes a
 * distance d by at most e^2 / d: it only matters for a touching segment.
 */
template <class T>
VP_KERNEL_INLINE Nearest<T> toCylinder(const V3<T> &from, const V3<T> &to, const T &radius, const T &half)
{
  const T zero = constant<T>(0.), one = constant<T>(1.), two = constant<T>(2.);
  const V3<T> d = to - from;
  T low = zero, high = one;
  T squared = zero, g = zero;
  T gLow = cylinderSlope(from, d, radius, half, low, squared),
    gHigh = cylinderSlope(from, d, radius, half, high, squared);
  const T A = d.x * d.x + d.y * d.y, B = from.x * d.x + from.y * d.y,
          C = from.x * from.x + from.y * from.y - radius * radius, D = root(larger(B * B - A * C, zero));
  const T kinks[5] = {ratio(half - from.z, d.z), ratio(T{} - half - from.z, d.z), ratio(T{} - B, A),
                      ratio(T{} - B - D, A), ratio(D - B, A)};
  for (const T &kink : kinks) {
    const T t = clamp(kink, zero, one);
    narrow(t, cylinderSlope(from, d, radius, half, t, squared), low, gLow, high, gHigh);
  }
  T t = gLow >= zero ? low : high;
  const auto open = (gLow < zero) & (gHigh > zero);
  T side = zero;
  for (int i = 0; i < rootSteps<T>() && (i == 0 || !isClosed<T>(high - low, g, squared)); ++i) {
    const bool halving = i % 4 == 3;
    const T secant = low + (high - low) * ratio(T{} - gLow, gHigh - gLow), middle = (low + high) / two;
    const T next = halving ? middle : clamp(secant, low, high);
    g = cylinderSlope(from, d, radius, half, next, squared);
    const auto left = g <= zero;
    // Illinois: the value of an end retained twice is halved, so that the secant does not stall.
    const T keptHigh = side > zero ? gHigh / two : gHigh, keptLow = side < zero ? gLow / two : gLow;
    gHigh = left ? keptHigh : g;
    gLow = left ? g : keptLow;
    low = left ? next : low;
    high = left ? high : next;
    side = left ? one : T{} - one;
    t = open ? next : t;
  }
  const V3<T> a = from + t * d;
  const T rho = root(a.x * a.x + a.y * a.y), scale = rho > radius ? ratio(radius, rho) : one;
  const V3<T> b = {scale * a.x, scale * a.y, clamp(a.z, T{} - half, half)};
  const V3<T> gap = a - b;
  return {root(dot(gap, gap)), a, b};
}
