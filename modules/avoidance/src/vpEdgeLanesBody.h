/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Included by vpEdgeLanes.cpp once per vector width, each time in a namespace that defines vpLane and lanes: not
// a template, because all of it must be compiled for the instruction set of the entry.

using Vector = V3<vpLane>;

struct Frame {
  Vector x, y, z, p;
};

//! Velocity per unit of s of the points of a body: at r it is linear + angular x r.
struct Twist {
  Vector linear, angular;
};

struct Capsule {
  Vector from, to;         // Ends of the axis.
  Vector fromRate, toRate; // Their velocities.
  Vector centre;           // Midpoint of the axis.
  vpLane fastest;          // Maximum speed of the axis points.
};

VP_KERNEL_INLINE vpLane filled(double v) { return constant<vpLane>(v); }
VP_KERNEL_INLINE Vector filled(double x, double y, double z) { return {filled(x), filled(y), filled(z)}; }
VP_KERNEL_INLINE Vector filled(const Eigen::Vector3d &v) { return {filled(v.x()), filled(v.y()), filled(v.z())}; }
VP_KERNEL_INLINE Vector place(const Frame &f, const Eigen::Vector3d &v)
{
  return f.p + filled(v.x()) * f.x + filled(v.y()) * f.y + filled(v.z()) * f.z;
}
VP_KERNEL_INLINE Vector turn(const Frame &f, const Eigen::Vector3d &v)
{
  return filled(v.x()) * f.x + filled(v.y()) * f.y + filled(v.z()) * f.z;
}
VP_KERNEL_INLINE vpLane absolute(const vpLane &v) { return v < 0. ? -v : v; }
VP_KERNEL_INLINE vpLane norm(const Vector &v) { return root(dot(v, v)); }
VP_KERNEL_INLINE Vector rate(const Twist &t, const Vector &p) { return t.linear + cross(t.angular, p); }

// Cosines and sines of equally spaced angles, by recurrence from two.
VP_KERNEL_INLINE void turns(double first, double step, vpLane &c, vpLane &s)
{
  c[0] = std::cos(first);
  s[0] = std::sin(first);
  double cd = std::cos(step), sd = std::sin(step);
  for (int done = 1; done < lanes; done *= 2) {
    for (int l = 0; l < done; ++l) {
      c[done + l] = c[l] * cd - s[l] * sd;
      s[done + l] = s[l] * cd + c[l] * sd;
    }
    const double twice = cd * cd - sd * sd;
    sd = 2. * sd * cd;
    cd = twice;
  }
}

// vpArmKinematics::forward() for every lane, with the velocities of the links along the motion.
VP_KERNEL_INLINE void placeArm(const vpEdgeMotion &motion, double first, double step, Frame *frames, Twist *twists)
{
  const vpArmModel &arm = *motion.arm;
  Frame now = {filled(1., 0., 0.), filled(0., 1., 0.), filled(0., 0., 1.), filled(0., 0., 0.)};
  Twist twist = {now.p, now.p};
  for (int i = 0; i < arm.links(); ++i) {
    const vpRigidTransform &T = arm.chain(i).step;
    const Frame placed = {turn(now, T.R.col(0)), turn(now, T.R.col(1)), turn(now, T.R.col(2)), place(now, T.p)};
    const double q = motion.from(i) + first * motion.change(i), dq = step * motion.change(i);
    const vpLane speed = filled(motion.change(i));
    now = placed;
    if (arm.chain(i).isPrismatic) {
      vpLane travel;
      for (int l = 0; l < lanes; ++l) {
        travel[l] = q + l * dq;
      }
      now.p = placed.p + travel * placed.z;
      twist.linear = twist.linear + speed * placed.z;
    }
    else {
      vpLane c = filled(0.), s = filled(0.);
      turns(q, dq, c, s);
      now.x = c * placed.x + s * placed.y;
      now.y = c * placed.y - s * placed.x;
      twist.linear = twist.linear + speed * cross(placed.p, placed.z);
      twist.angular = twist.angular + speed * placed.z;
    }
    frames[i] = now;
    twists[i] = twist;
  }
}

VP_KERNEL_INLINE void placeCapsule(const vpEdgeCapsule &c, const Frame *frames, const Twist *twists, Capsule &to)
{
  if (c.link == 0) {
    to.from = filled(c.from);
    to.to = filled(c.to);
    to.fromRate = to.toRate = filled(0., 0., 0.);
    to.centre = filled(0.5) * (to.from + to.to);
    to.fastest = filled(0.);
    return;
  }
  to.from = place(frames[c.link - 1], c.from);
  to.to = place(frames[c.link - 1], c.to);
  to.fromRate = rate(twists[c.link - 1], to.from);
  to.toRate = rate(twists[c.link - 1], to.to);
  to.centre = filled(0.5) * (to.from + to.to);
  to.fastest = larger(norm(to.fromRate), norm(to.toRate));
}

// Transforms into the axes of an object.
VP_KERNEL_INLINE Vector local(const vpRigidTransform &T, const Vector &p)
{
  const Vector d = p - filled(T.p);
  return {dot(filled(T.R.col(0)), d), dot(filled(T.R.col(1)), d), dot(filled(T.R.col(2)), d)};
}
VP_KERNEL_INLINE Vector global(const vpRigidTransform &T, const Vector &v)
{
  const Vector x = filled(T.R.col(0)), y = filled(T.R.col(1)), z = filled(T.R.col(2));
  return filled(T.p) + v.x * x + v.y * y + v.z * z;
}

VP_KERNEL_INLINE Nearest<vpLane> toCore(const vpCollisionCore &core, const Capsule &c)
{
  if (core.type == vpShapeType::Sphere) {
    return toPoint(c.from, c.to, filled(core.pose.p));
  }
  if (core.type == vpShapeType::Capsule) {
    return toSegment(c.from, c.to, filled(core.end(-1.)), filled(core.end(1.)));
  }
  const Vector from = local(core.pose, c.from), to = local(core.pose, c.to);
  Nearest<vpLane> near;
  if (core.type == vpShapeType::Box) {
    near = toBox(from, to, filled(core.half));
  }
  else {
    near = toCylinder(from, to, filled(core.half.x()), filled(core.half.z()));
  }
  near.a = global(core.pose, near.a);
  near.b = global(core.pose, near.b);
  return near;
}

struct Verdict {
  vpLane clearance; // Minus the margin.
  vpLane slack;     // Remaining clearance after the motion.
};

// Clearance left between an end of the axis and the separating plane after its motion.
VP_KERNEL_INLINE vpLane leftOf(const Vector &normal, const vpLane &height, const Vector &speed, double radii,
                               double half, double acceleration)
{
  return height - radii - normalRounding - half * absolute(dot(normal, speed)) - 0.5 * half * half * acceleration;
}

//! Bounds from the nearest points of convex cores.
VP_KERNEL_INLINE Verdict judge(const Nearest<vpLane> &near, const Capsule &c, const vpLane &need, double radii,
                               double half, double acceleration)
{
  Verdict v;
  v.clearance = near.distance - radii;
  const Vector normal = ratio(filled(1.), near.distance) * (near.a - near.b);
  const vpLane from = leftOf(normal, dot(normal, c.from - near.b), c.fromRate, radii, half, acceleration);
  const vpLane to = leftOf(normal, dot(normal, c.to - near.b), c.toRate, radii, half, acceleration);
  v.slack = larger(v.clearance - need, smaller(from, to));
  return v;
}

// Meshes and octrees: lane by lane, only where needed.
VP_KERNEL_INLINE Verdict walk(const vpCollisionCore &core, const Capsule &c, const vpLane &need, const vpLane &apart,
                              double radii)
{
  Verdict v = {apart, apart - need};
  for (int l = 0; l < lanes; ++l) {
    if (!(v.slack[l] > rounding)) {
      const Eigen::Vector3d from(c.from.x[l], c.from.y[l], c.from.z[l]), to(c.to.x[l], c.to.y[l], c.to.z[l]);
      const double cutoff = radii + need[l] + 2. * rounding;
      v.clearance[l] = std::fmin(core.nearest(from, to, cutoff).distance, cutoff) - radii;
      v.slack[l] = v.clearance[l] - need[l];
    }
  }
  return v;
}

VP_KERNEL_INLINE bool all(const vpLane &slack)
{
  bool yes = true;
  for (int l = 0; l < lanes; ++l) {
    yes = yes && slack[l] > rounding;
  }
  return yes;
}

//! Numbers of a pair that are the same for all lanes.
struct Size {
  double radii;  // Sum of both radii and the margin, m.
  double bounds; // Sum of both bounding spheres of the cores, both radii and the margin, m.
};

//! Largest motion of a capsule around each lane.
VP_KERNEL_INLINE vpLane motionOf(const Capsule &c, const vpEdgeBound &bound, double half)
{
  return smaller(filled(half * bound.speed), half * c.fastest + 0.5 * half * half * bound.acceleration);
}

VP_KERNEL_INLINE Verdict judgeObject(const vpCollisionCore &core, const Capsule &c, const Size &size,
                                     const vpEdgeBound &bound, double half)
{
  const vpLane need = motionOf(c, bound, half);
  // Bounding spheres first: sufficient for most pairs.
  const vpLane apart = norm(c.centre - filled(core.centre)) - size.bounds;
  if (all(apart - need)) {
    return {apart, apart - need};
  }
  return core.isConvex() ? judge(toCore(core, c), c, need, size.radii, half, bound.acceleration)
                         : walk(core, c, need, apart, size.radii);
}

// In the frame of the inner capsule's link, where that capsule is at rest.
VP_KERNEL_INLINE Verdict judgeSelf(const Capsule &inner, const Twist &innerTwist, const Capsule &outer,
                                   const Size &size, const vpEdgeBound &bound, double half)
{
  Capsule seen = outer;
  seen.fromRate = outer.fromRate - rate(innerTwist, outer.from);
  seen.toRate = outer.toRate - rate(innerTwist, outer.to);
  const vpLane fastest = larger(norm(seen.fromRate), norm(seen.toRate));
  const vpLane need = smaller(filled(half * bound.speed), half * fastest + 0.5 * half * half * bound.acceleration);
  const vpLane apart = norm(outer.centre - inner.centre) - size.bounds;
  if (all(apart - need)) {
    return {apart, apart - need};
  }
  return judge(toSegment(outer.from, outer.to, inner.from, inner.to), seen, need, size.radii, half, bound.acceleration);
}

VP_KERNEL_INLINE Verdict judgeGround(const vpHalfSpace &ground, const Capsule &c, const Size &size,
                                     const vpEdgeBound &bound, double half)
{
  const Vector normal = filled(ground.normal);
  const vpLane from = dot(normal, c.from) - ground.offset, to = dot(normal, c.to) - ground.offset;
  return {smaller(from, to) - size.radii,
          smaller(leftOf(normal, from, c.fromRate, size.radii, half, bound.acceleration),
                  leftOf(normal, to, c.toRate, size.radii, half, bound.acceleration))};
}

//! The arm at the lanes; capsules are placed when they are needed.
struct Arm {
  Frame frames[vpArmMaxJoints];
  Twist twists[vpArmMaxJoints];
  Capsule capsules[vpEdgeMostCapsules];
  bool placed[vpEdgeMostCapsules];
};

VP_KERNEL_INLINE const Capsule &capsuleAt(const vpEdgeMotion &motion, int i, Arm &arm)
{
  if (!arm.placed[i]) {
    placeCapsule(motion.capsules[i], arm.frames, arm.twists, arm.capsules[i]);
    arm.placed[i] = true;
  }
  return arm.capsules[i];
}

VP_KERNEL_INLINE Verdict judgePair(const vpEdgeMotion &motion, const vpEdgePair &pair, double half, Arm &arm)
{
  const vpEdgeCapsule &own = motion.capsules[pair.capsule];
  const Capsule &c = capsuleAt(motion, pair.capsule, arm);
  const vpEdgeBound &bound =
      motion.bounds[static_cast<std::size_t>(own.link)][static_cast<std::size_t>(pair.innerLink)];
  const double radius = own.radius + motion.margin;
  if (pair.kind == vpCollisionKind::Object) {
    const vpCollisionCore &core = motion.cores[pair.other];
    const double radii = radius + core.radius;
    return judgeObject(core, c, {radii, radii + own.halfLength + core.bound}, bound, half);
  }
  if (pair.kind == vpCollisionKind::Self) {
    const vpEdgeCapsule &other = motion.capsules[pair.other];
    const double radii = radius + other.radius;
    const Twist still = {filled(0., 0., 0.), filled(0., 0., 0.)};
    return judgeSelf(capsuleAt(motion, pair.other, arm), pair.innerLink > 0 ? arm.twists[pair.innerLink - 1] : still, c,
                     {radii, radii + own.halfLength + other.halfLength}, bound, half);
  }
  return judgeGround(*motion.ground, c, {radius, radius}, bound, half);
}

// Box of a capsule at all lanes and, with its motion, around them; all of space if a number is NaN.
VP_KERNEL_INLINE Eigen::AlignedBox3d boxOf(const Capsule &c, double radius, const vpLane &moves)
{
  constexpr double slack = 1e-6; // m, more than all rounding
  const vpLane out = moves + (radius + slack);
  const vpLane *const from[3] = {&c.from.x, &c.from.y, &c.from.z}, *const to[3] = {&c.to.x, &c.to.y, &c.to.z};
  Eigen::AlignedBox3d box;
  bool known = true;
  for (int i = 0; i < 3; ++i) {
    const vpLane low = smaller(*from[i], *to[i]) - out, high = larger(*from[i], *to[i]) + out;
    for (int l = 0; l < lanes; ++l) {
      box.min()[i] = low[l] < box.min()[i] ? low[l] : box.min()[i];
      box.max()[i] = high[l] > box.max()[i] ? high[l] : box.max()[i];
      known = known && low[l] <= high[l];
    }
  }
  if (!known) {
    box.min().setConstant(-std::numeric_limits<double>::infinity());
    box.max().setConstant(std::numeric_limits<double>::infinity());
  }
  return box;
}

//! The pairs with objects whose boxes meet those of the links. The outermost link first: it moves most.
struct NearObjects {
  const vpEdgeObjects *objects; // null: none
  int hull;                     // of the search
  std::optional<vpObjectSearch> search;
};

// The next pair, or unchecked at the end.
VP_KERNEL_INLINE std::uint32_t nextPair(const vpEdgeMotion &motion, double half, Arm &arm, NearObjects &near)
{
  while (near.objects != nullptr) {
    const vpEdgeObjects &objects = *near.objects;
    for (int j = near.search ? near.search->next(0.) : -1; j >= 0; j = near.search->next(0.)) {
      const std::uint32_t index = objects.pairs[j * objects.hulls + near.hull];
      if (index != vpEdgeObjects::unchecked) {
        return index;
      }
    }
    near.search.reset();
    if (--near.hull < 0) {
      near.objects = nullptr;
    }
    else if (motion.capsules[objects.firstHull + near.hull].link > 0) {
      const vpEdgeCapsule &own = motion.capsules[objects.firstHull + near.hull];
      const Capsule &c = capsuleAt(motion, objects.firstHull + near.hull, arm);
      const vpLane moves = motionOf(c, motion.bounds[static_cast<std::size_t>(own.link)][0], half);
      near.search.emplace(*objects.tree, boxOf(c, own.radius + motion.margin, moves), 0.);
    }
  }
  return vpEdgeObjects::unchecked;
}

// Bits of the lanes that the numbers do not exceed; written such that NaN exceeds nothing.
VP_KERNEL_INLINE unsigned int lanesBelow(const vpLane &value, double limit)
{
  unsigned int mask = 0;
  for (int l = 0; l < lanes; ++l) {
    mask |= value[l] > limit ? 0U : 1U << l;
  }
  return mask;
}

// Lanes group..group + lanes - 1 of the eight. False when a pair collides.
VP_KERNEL_INLINE bool evaluate(const vpEdgeMotion &motion, const vpEdgePair *pairs, const std::uint32_t *list,
                               int count, double start, double piece, int group, vpEdgeBatch &batch)
{
  Arm arm;
  std::fill_n(arm.placed, vpEdgeMostCapsules, false);
  placeArm(motion, start + (group + 0.5) * piece, piece, arm.frames, arm.twists);
  const double half = 0.5 * piece;
  vpLane tightest = filled(std::numeric_limits<double>::infinity());
  NearObjects near = {batch.objects, batch.objects != nullptr ? batch.objects->hulls : 0, std::nullopt};
  std::uint32_t child = 0, lastChild = 0; // those of a bounding pair come after it
  for (int k = 0;;) {
    std::uint32_t index = child < lastChild ? child++ : nextPair(motion, half, arm, near);
    if (index == vpEdgeObjects::unchecked) {
      if (k == count) {
        break;
      }
      index = list[k++];
    }
    const vpEdgePair &pair = pairs[index];
    const Verdict v = judgePair(motion, pair, half, arm);
    const unsigned int mask = lanesBelow(v.slack, rounding);
    if (pair.begin < pair.end) {
      if (mask != 0) {
        child = pair.begin;
        lastChild = pair.end;
      }
      continue;
    }
    tightest = smaller(tightest, v.slack);
    if (mask == 0) {
      continue;
    }
    if (batch.unproven[index] == 0) {
      batch.open[batch.count++] = index;
      batch.touched[index] = 0;
    }
    const unsigned int touched = mask & lanesBelow(v.clearance, 0.);
    batch.unproven[index] = static_cast<std::uint8_t>(batch.unproven[index] | mask << group);
    batch.touched[index] = static_cast<std::uint8_t>(batch.touched[index] | touched << group);
    for (int l = 0; touched != 0 && pair.exact < 0 && l < lanes; ++l) {
      if ((touched >> l & 1U) != 0) {
        batch.hitPair = static_cast<int>(index);
        batch.hitLane = group + l;
        return false;
      }
    }
  }
  for (int l = 0; l < lanes; ++l) {
    batch.slack[group + l] = tightest[l] == tightest[l] ? tightest[l] : -std::numeric_limits<double>::infinity();
  }
  return true;
}
