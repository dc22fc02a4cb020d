/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Printed control laws of thesis chapter 5 compared with those used here, on the same random poses. The oracle is
// ViSP's exponential map: the evolution of the errors while the camera follows the law. See doc/errata.md.
#include "vpCatch.h"
#include "vpServoScene.h"

#include <functional>

namespace
{
using namespace vpServoScene;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Quantity = std::function<Eigen::VectorXd(const vpHomogeneousMatrix &)>;

const std::vector<Eigen::Vector3d> origin(1, Eigen::Vector3d::Zero());

struct Situation {
  vpHomogeneousMatrix cdMo, cMo;
  Eigen::Matrix3d R() const { return rotation(cdMo) * rotation(cMo).transpose(); } // of cdMc
  Eigen::Vector3d t() const { return translation(cdMo) - R() * translation(cMo); }
  Eigen::Vector3d thetaU() const
  {
    const Eigen::AngleAxisd a(R());
    return a.angle() * a.axis();
  }
};

Situation randomSituation(std::mt19937_64 &rng)
{
  Situation s;
  do {
    s.cdMo = randomPose(rng, 0.4, 1.2, 0.3, 0.6);
    s.cMo =
        pose(turn(uniform(rng, 0.3, 0.8), direction(rng)), uniform(rng, 0.1, 0.3) * direction(rng)).inverse() * s.cdMo;
  } while (translation(s.cMo).z() < 0.3 || translation(s.cMo).head<2>().norm() > 0.4 * translation(s.cMo).z());
  return s;
}

Eigen::Vector2d image(const vpHomogeneousMatrix &cMo) { return translation(cMo).head<2>() / translation(cMo).z(); }

vpTwist twistOf(const Vector6 &v) { return {v[0], v[1], v[2], v[3], v[4], v[5]}; }

// Rate of a quantity while the camera moves.
Eigen::VectorXd rate(const Quantity &quantity, const vpHomogeneousMatrix &cMo, const vpTwist &v)
{
  const double h = 1e-5;
  return (quantity(move(cMo, v, h)) - quantity(move(cMo, v, -h))) / (2. * h);
}

// Output of the law with all gains 1.
vpTwist answer(const std::string &id, const Situation &s)
{
  auto law = vpServoLaw::create(id);
  law->setGoal(goal(s.cdMo, origin));
  vpServoMeasurement measurement;
  measure(s.cMo, origin, measurement);
  const vpServoCommand command = law->step(measurement, 0.01);
  REQUIRE(command.status == vpServoStatus::Servoing);
  return command.v;
}
} // namespace

TEST_CASE("(5.13) as printed lacks a sign: the object's place does not decay", "[errata]")
{
  auto rng = vpTestSupport::generator(61);
  CAPTURE(vpTestSupport::seed());
  int grows = 0;
  for (int k = 0; k < 500; ++k) {
    const Situation s = randomSituation(rng);
    const Eigen::Vector3d to = translation(s.cMo), te = to - translation(s.cdMo), turning = s.thetaU();
    const Quantity place = [&](const vpHomogeneousMatrix &cMo) {
      return Eigen::Vector3d(translation(cMo) - translation(s.cdMo));
    };
    REQUIRE((rate(place, s.cMo, answer("pbvs2", s)) + te).norm() < 1e-6);
    Vector6 printed;
    printed << -(te + to.cross(turning)), -turning;
    grows += te.dot(rate(place, s.cMo, twistOf(printed))) > 0.;
  }
  CHECK(grows == 500);
}

TEST_CASE("(5.16) as printed is the motion of the object: the camera leads the image away", "[errata]")
{
  auto rng = vpTestSupport::generator(62);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 500; ++k) {
    const Situation s = randomSituation(rng);
    const double u = image(s.cMo).x(), v = image(s.cMo).y(), z = translation(s.cMo).z();
    Eigen::Matrix<double, 2, 6> printed; // f = 1
    printed << 1. / z, 0., -u / z, -u * v, 1. + u * u, -v, 0., 1. / z, -v / z, -1. - v * v, u * v, u;
    const vpTwist twist = randomTwist(rng, 0.5, 0.5);
    const Quantity point = [](const vpHomogeneousMatrix &cMo) { return Eigen::VectorXd(image(cMo)); };
    const Vector6 w = Eigen::Map<const Vector6>(twist.data());
    REQUIRE((rate(point, s.cMo, twist) + printed * w).norm() < 1e-6);
    // So the law (5.8) with it increases the error as fast as it should decrease.
    const Eigen::Vector2d e = image(s.cMo) - image(s.cdMo);
    const Vector6 law = -printed.transpose() * (printed * printed.transpose()).inverse() * e;
    REQUIRE((rate(point, s.cMo, twistOf(law)) - e).norm() < 1e-6);
  }
}

TEST_CASE("(5.22): the first block is R, not the identity, and the roll needs the third row of (5.6)", "[errata]")
{
  auto rng = vpTestSupport::generator(63);
  CAPTURE(vpTestSupport::seed());
  int wrongRow = 0;
  for (int k = 0; k < 500; ++k) {
    const Situation s = randomSituation(rng);
    const Quantity place = [&](const vpHomogeneousMatrix &cMo) { return Eigen::VectorXd(Situation{s.cdMo, cMo}.t()); };
    const Quantity roll = [&](const vpHomogeneousMatrix &cMo) {
      return Eigen::VectorXd::Constant(1, Situation{s.cdMo, cMo}.thetaU().z());
    };
    const vpTwist twist = randomTwist(rng, 1., 1.);
    const Eigen::Vector3d v(twist[0], twist[1], twist[2]), t = s.t();
    REQUIRE((rate(place, s.cMo, twist) - s.R() * v).norm() < 1e-6);
    REQUIRE((rate(place, s.cMo, twist) - v).norm() > 1e-3);
    wrongRow += std::abs(rate(roll, s.cMo, twist)[0] - twist[5]) > 0.05; // (0 0 0 0 0 1) v as printed
    // The law makes the camera move straight and the roll decay at the same time.
    const vpTwist kyrki = answer("kyrki", s);
    REQUIRE((rate(place, s.cMo, kyrki) + t).norm() < 1e-6);
    REQUIRE(std::abs(rate(roll, s.cMo, kyrki)[0] + s.thetaU().z()) < 1e-5);
  }
  CHECK(wrongRow > 250);
}

TEST_CASE("(5.26) and (5.28) as printed turn about the wrong axis: the object goes aside, not back", "[errata]")
{
  // Camera at the goal, except that the object is displaced by u: only the image term acts.
  for (const double u : {-0.3, -0.1, 0.1, 0.3}) {
    const vpHomogeneousMatrix cdMo = pose(Eigen::Matrix3d::Identity(), {0., 0., 1.});
    const Situation s{cdMo, pose(Eigen::Matrix3d::Identity(), {u, 0., 1.})};
    const Quantity point = [](const vpHomogeneousMatrix &cMo) { return Eigen::VectorXd(image(cMo)); };
    for (const double sign : {1., -1.}) {
      // theta_x = c tanh(u), theta_y = c tanh(v) in e_w, omega = -lambda e_w, with either reading of the signs.
      const vpTwist printed(0., 0., 0., -sign * 0.5 * std::tanh(u / 0.5), 0., 0.);
      const Eigen::Vector2d moved = rate(point, s.cMo, printed);
      CHECK(std::abs(moved.x()) < 1e-9);
      CHECK(std::abs(moved.y()) > 0.05);
    }
    vpTwist law = answer("ff-sum", s);
    for (std::size_t i = 0; i < 3; ++i) {
      law[i] = 0.; // the translation is that of pbvs1
    }
    const Eigen::Vector2d moved = rate(point, s.cMo, law);
    CHECK(u * moved.x() < -0.5 * u * u);
    CHECK(std::abs(moved.y()) < 1e-9);
  }
}
