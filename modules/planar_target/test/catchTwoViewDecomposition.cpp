/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"

#include <visp3/core/vpThetaUVector.h>
#include <visp3/planar_target/vpTwoViewDecomposition.h>

#include <cmath>
#include <iostream>

VISP_DIRECT_USING_NAMESPACE

namespace
{
using Points = std::vector<std::pair<double, double>>;

struct Motion {
  vpRotationMatrix R;
  vpTranslationVector t; // over d
};

vpColVector unit(double x, double y, double z)
{
  vpColVector n(3);
  n[0] = x;
  n[1] = y;
  n[2] = z;
  return n / std::sqrt(n.sumSquare());
}

double angle(const vpColVector &a, const vpColVector &b)
{
  return std::acos(std::min(1., std::abs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])));
}

// H = R + t n^T / d, times any factor: homographies come without scale and sign.
vpHomography homography(const Motion &m, const vpColVector &n, double scale)
{
  vpHomography H;
  for (unsigned int r = 0; r < 3; ++r) {
    for (unsigned int c = 0; c < 3; ++c) {
      H[r][c] = scale * (m.R[r][c] + m.t[r] * n[c]);
    }
  }
  return H;
}

class World
{
public:
  explicit World(unsigned int index) : m_rng(vpTestSupport::generator(index))
  {
    normal = unit(uniform(-0.5, 0.5), uniform(-0.5, 0.5), 1.);
    while (points.size() < 8) {
      const std::pair<double, double> p(uniform(-0.4, 0.4), uniform(-0.3, 0.3));
      if (depth(p) > 0.) {
        points.push_back(p);
      }
    }
  }
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(m_rng); }
  double scale() { return (uniform(0., 1.) < 0.5 ? -1. : 1.) * uniform(0.2, 5.); }

  // A motion after which all points are in front of the second camera too.
  Motion motion(double shortest = 0.1)
  {
    for (;;) {
      Motion m;
      m.R = vpRotationMatrix(vpThetaUVector(uniform(-0.5, 0.5), uniform(-0.5, 0.5), uniform(-1., 1.)));
      m.t = vpTranslationVector(uniform(-0.5, 0.5), uniform(-0.5, 0.5), uniform(-0.4, 0.4));
      bool inFront = std::sqrt(m.t.sumSquare()) > shortest;
      for (const auto &p : points) {
        const double z = m.R[2][0] * p.first + m.R[2][1] * p.second + m.R[2][2] + m.t[2] * depth(p);
        inFront = inFront && z > 0.;
      }
      if (inFront) {
        return m;
      }
    }
  }
  double depth(const std::pair<double, double> &p) const
  {
    return normal[0] * p.first + normal[1] * p.second + normal[2];
  }

  vpColVector normal;
  Points points;

private:
  std::mt19937_64 m_rng;
};

// Where two singular values differ by less than 1e-4, vpHomography takes them for equal, which costs sqrt(1e-4).
double tolerance(const vpHomography &H)
{
  vpColVector sigma;
  vpMatrix U = H.convert(), V;
  U.svd(sigma, V);
  const double low = std::min({sigma[0], sigma[1], sigma[2]}), high = std::max({sigma[0], sigma[1], sigma[2]});
  const double middle = sigma[0] + sigma[1] + sigma[2] - low - high;
  return std::min(high - middle, middle - low) < 1e-3 * middle ? 0.03 : 1e-6;
}

bool isTrue(const vpTwoViewMotion &found, const Motion &truth, const vpColVector &normal)
{
  double worst = 0.;
  for (unsigned int r = 0; r < 3; ++r) {
    worst = std::max({worst, std::abs(found.t[r] - truth.t[r]), std::abs(found.normal[r] - normal[r])});
    for (unsigned int c = 0; c < 3; ++c) {
      worst = std::max(worst, std::abs(found.c2Rc1[r][c] - truth.R[r][c]));
    }
  }
  return worst < tolerance(homography(truth, normal, 1.));
}
} // namespace

TEST_CASE("the true motion is among the candidates, and what a prior or depth picks is true", "[two-view]")
{
  CAPTURE(vpTestSupport::seed());
  unsigned int unique = 0, twofold = 0;
  for (unsigned int i = 0; i < 2000; ++i) {
    World world(1000 + i);
    const Motion truth = world.motion();
    const vpHomography H = homography(truth, world.normal, world.scale());
    CAPTURE(i);

    vpTwoViewDecomposition blind;
    const vpTwoViewResult &result = blind.process(H, world.points);
    REQUIRE(std::any_of(result.candidates.begin(), result.candidates.end(),
                        [&](const vpTwoViewMotion &m) { return isTrue(m, truth, world.normal); }));
    REQUIRE(result.candidates.size() <= 2);
    if (result.status == vpTwoViewStatus::Unique) {
      ++unique;
      REQUIRE(isTrue(result.best, truth, world.normal));
    }
    else {
      ++twofold;
      REQUIRE(result.status == vpTwoViewStatus::Ambiguous);
    }

    vpTwoViewDecomposition informed;
    informed.setNormalPrior(unit(world.normal[0] + 0.05, world.normal[1] - 0.05, world.normal[2]));
    informed.process(H, world.points);
    const bool close =
        result.candidates.size() == 2 && angle(result.candidates[0].normal, result.candidates[1].normal) < 0.3;
    if (!close) {
      REQUIRE(informed.result().status == vpTwoViewStatus::Unique);
      REQUIRE(isTrue(informed.result().best, truth, world.normal));
    }
  }
  std::cout << "two views: " << unique << " of 2000 decided by positive depth, " << twofold << " ambiguous"
            << std::endl;
  CHECK(unique > 100); // both branches are exercised
  CHECK(twofold > 100);
}

TEST_CASE("further motions decide between the two planes, and never for the false one", "[two-view]")
{
  CAPTURE(vpTestSupport::seed());
  unsigned int decided = 0;
  double frames = 0.;
  for (unsigned int i = 0; i < 500; ++i) {
    World world(5000 + i);
    vpTwoViewDecomposition decomposition;
    bool done = false;
    double apart = M_PI; // the two planes that the first frame allows, rad
    for (unsigned int frame = 1; frame <= 10; ++frame) {
      const Motion truth = world.motion();
      const vpTwoViewResult &result =
          decomposition.process(homography(truth, world.normal, world.scale()), world.points);
      CAPTURE(i, frame, result.message);
      if (frame == 1 && result.candidates.size() == 2) {
        apart = angle(result.candidates[0].normal, result.candidates[1].normal);
      }
      if (result.status == vpTwoViewStatus::Unique) {
        REQUIRE(isTrue(result.best, truth, world.normal));
        frames += done ? 0. : frame;
        done = true;
      }
      else {
        REQUIRE(result.status == vpTwoViewStatus::Ambiguous);
        REQUIRE_FALSE(done); // once decided, it stays
      }
    }
    // Planes within the tolerance of normals confirm each other forever.
    CAPTURE(i, apart);
    CHECK((done || apart < vpTwoViewSpec().normalTolerance));
    decided += done;
  }
  std::cout << "several views: " << decided << " of 500 decided, after " << frames / decided << " frames on average"
            << std::endl;
  CHECK(decided > 490);
}

TEST_CASE("a camera that only turns gives a status and no motion", "[two-view]")
{
  CAPTURE(vpTestSupport::seed());
  for (unsigned int i = 0; i < 500; ++i) {
    World world(7000 + i);
    Motion m = world.motion();
    const double length = world.uniform(0., 0.019); // of the plane's distance; the threshold is 0.02
    m.t *= length / std::sqrt(m.t.sumSquare());
    vpTwoViewDecomposition decomposition;
    decomposition.setNormalPrior(world.normal);
    CAPTURE(i, length);
    REQUIRE(decomposition.process(homography(m, world.normal, world.scale()), world.points).status ==
            vpTwoViewStatus::PureRotation);
    REQUIRE(decomposition.result().candidates.empty());
  }
}

TEST_CASE("motion along the normal has one plane only", "[two-view]")
{
  World world(8000);
  Motion m;
  m.R = vpRotationMatrix(vpThetaUVector(0.1, -0.2, 0.3));
  m.t = vpTranslationVector();
  for (unsigned int r = 0; r < 3; ++r) { // t parallel to R n: towards the plane
    m.t[r] = 0.2 * (m.R[r][0] * world.normal[0] + m.R[r][1] * world.normal[1] + m.R[r][2] * world.normal[2]);
  }
  vpTwoViewDecomposition decomposition;
  REQUIRE(decomposition.process(homography(m, world.normal, 1.), world.points).status == vpTwoViewStatus::Unique);
  CHECK(isTrue(decomposition.result().best, m, world.normal));
}

TEST_CASE("what cannot be decomposed is refused", "[two-view][errors]")
{
  World world(9000);
  vpTwoViewDecomposition decomposition;
  vpHomography H = homography(world.motion(), world.normal, 1.);
  CHECK(decomposition.process(H, {}).status == vpTwoViewStatus::Invalid);
  H[1][1] = NAN;
  CHECK(decomposition.process(H, world.points).status == vpTwoViewStatus::Invalid);
  for (unsigned int c = 0; c < 3; ++c) {
    H[1][c] = H[0][c];
  }
  CHECK(decomposition.process(H, world.points).status == vpTwoViewStatus::Invalid);

  // A plane has two sides, and a camera sees one: det(R + t n^T / d) > 0.
  for (unsigned int mirror = 0; mirror < 2; ++mirror) {
    for (unsigned int trial = 0; trial < 50; ++trial) {
      World other(9100 + trial);
      vpHomography mirrored = homography(other.motion(), other.normal, 1.);
      for (unsigned int c = 0; c < 3; ++c) {
        mirrored[mirror][c] = -mirrored[mirror][c];
      }
      CHECK(decomposition.process(mirrored, other.points).status == vpTwoViewStatus::Invalid);
      CHECK(decomposition.result().message.find("The homography is mirrored") == 0);
      CHECK(decomposition.result().candidates.empty());
    }
  }
  for (const double bad : {double(NAN), double(INFINITY)}) {
    auto points = world.points;
    points[points.size() - 1].second = bad;
    CHECK(decomposition.process(homography(world.motion(), world.normal, 1.), points).status ==
          vpTwoViewStatus::Invalid);
    CHECK(decomposition.result().message.find("Point " + std::to_string(points.size() - 1) + " of the plane is (") ==
          0);
    CHECK(decomposition.result().message.find(", must be finite.") != std::string::npos);
  }

  vpTwoViewSpec spec;
  spec.minTranslation = -1.;
  CHECK_THROWS_WITH(vpTwoViewDecomposition(spec),
                    Catch::Contains("minTranslation of the two-view decomposition is -1"));
  CHECK_THROWS_WITH(decomposition.setNormalPrior(vpColVector(3)), Catch::Contains("must be finite and not zero"));
  CHECK_THROWS_WITH(decomposition.setNormalPrior(vpColVector(2)), Catch::Contains("has 2 components"));
}
