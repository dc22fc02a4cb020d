/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The track table against objects with known motion, and against independent estimates; what comes in, what goes out,
// and how a scene follows it.
#include "vpCatch.h"
#include "vpTrackTestKit.h"

#include <visp3/core/vpException.h>

#include <Eigen/Cholesky>

#include <vector>

using namespace vpTrackTestKit;

TEST_CASE("Errors of a track are as large as it says, whatever the motion, rate and latency", "[tracks]")
{
  auto rng = vpTestSupport::generator(701);
  CAPTURE(vpTestSupport::seed());
  vpObjectTrackSpec spec = withoutRest();
  spec.gate = 8.; // some of the 12,000 sightings are five deviations off
  constexpr int runs = 600;
  double place = 0., speed = 0., turn = 0.;
  for (int run = 0; run < runs; ++run) {
    Body body;
    body.p = point(rng, 1.);
    body.R = pose(rng, 1.).R;
    body.v = normal3(rng, spec.startVelocity);
    body.w = normal3(rng, spec.startTurn);
    const double sigma = uniform(rng, 0.0005, 0.01), angle = uniform(rng, 0.002, 0.03);
    vpObjectTracks tracks(spec);
    double t = 1e6 * (run % 2); // clocks may show large numbers
    const int frames = 2 + run % 20;
    for (int k = 0; k < frames; ++k) {
      REQUIRE(tracks.add(body.seen(t, rng, sigma, angle)));
      const double dt = uniform(rng, 0.01, 0.12);
      body.move(dt, density(spec.acceleration, spec), density(spec.angularAcceleration, spec), rng);
      t += dt;
    }
    tracks.advance(t);
    const vpObjectTrack &track = tracks.tracks().front();
    place += (track.pose.p - body.p).squaredNorm() / std::pow(track.positionSigma, 2);
    speed += (linear(track) - body.v).squaredNorm() / std::pow(track.velocitySigma, 2);
    turn += vpSO3::log(track.pose.R * body.R.transpose()).squaredNorm() / std::pow(track.angleSigma, 2);
  }
  // Sums of squares of 3 x 600 normal numbers: 1800 +- 60. Five standard deviations either way.
  constexpr double mean = 3. * runs, band = 5. * 60.;
  CHECK(std::fabs(place - mean) < band);
  CHECK(std::fabs(speed - mean) < band);
  CHECK(std::fabs(turn - mean) < band);
}

TEST_CASE("Place, velocity and their deviations are those of the best estimate from all sightings at once", "[tracks]")
{
  auto rng = vpTestSupport::generator(702);
  CAPTURE(vpTestSupport::seed());
  const vpObjectTrackSpec spec = withoutRest();
  const double q = density(spec.acceleration, spec);
  for (int problem = 0; problem < 30; ++problem) {
    // Gaussian regression with the covariance of integrated white noise; it attains the (Bayesian) Cramer-Rao bound.
    const double r = std::pow(uniform(rng, 0.001, 0.005), 2);
    Body body;
    body.v = normal3(rng, spec.startVelocity);
    vpObjectTracks tracks(spec);
    std::vector<double> times;
    std::vector<Vector3d> seen;
    for (double t = 0., dt = 0.; times.size() < 15; t += dt) {
      const vpObjectSighting sighting = body.seen(t, rng, std::sqrt(r), 1e-3);
      REQUIRE(tracks.add(sighting));
      times.push_back(t);
      seen.push_back(sighting.pose.p);
      dt = uniform(rng, 0.01, 0.1);
      body.move(dt, q, 0., rng);
    }
    const double now = times.back() + 0.05;
    tracks.advance(now);
    const auto place = [&](double s, double t) { // covariance of place and place, given the first sighting
      const double a = std::min(s, t), b = std::max(s, t);
      return r + std::pow(spec.startVelocity, 2) * s * t + q * (a * a * b / 2. - a * a * a / 6.);
    };
    const auto rate = [&](double s) { return std::pow(spec.startVelocity, 2) * s + q * s * s / 2.; }; // place, rate now
    const int n = static_cast<int>(times.size()) - 1;
    Eigen::MatrixXd C(n, n), z(n, 3), k(n, 2);
    for (int i = 0; i < n; ++i) {
      const double s = times[static_cast<std::size_t>(i) + 1];
      for (int j = 0; j < n; ++j) {
        C(i, j) = place(s, times[static_cast<std::size_t>(j) + 1]) + (i == j ? r : 0.);
      }
      z.row(i) = (seen[static_cast<std::size_t>(i) + 1] - seen[0]).transpose();
      k.row(i) << place(s, now), rate(s);
    }
    const Eigen::MatrixXd weights = C.ldlt().solve(k);
    const Eigen::MatrixXd best = weights.transpose() * z, gained = weights.transpose() * k;
    const vpObjectTrack &track = tracks.tracks().front();
    CHECK((track.pose.p - seen[0] - best.row(0).transpose()).norm() < 1e-9);
    CHECK((linear(track) - best.row(1).transpose()).norm() < 1e-8);
    CHECK(track.positionSigma == Approx(std::sqrt(place(now, now) - gained(0, 0))).epsilon(1e-6));
    CHECK(track.velocitySigma ==
          Approx(std::sqrt(std::pow(spec.startVelocity, 2) + q * now - gained(1, 1))).epsilon(1e-6));
  }
}

TEST_CASE("Sightings that come 50 ms late say where the object is now, not where it was", "[tracks]")
{
  auto rng = vpTestSupport::generator(703);
  CAPTURE(vpTestSupport::seed());
  for (int run = 0; run < 20; ++run) {
    Body body;
    body.p = point(rng, 1.);
    body.v = 0.4 * point(rng, 1.).normalized();
    body.w = 0.5 * point(rng, 1.).normalized();
    const Body start = body;
    vpObjectTracks tracks;
    for (int k = 0; k < 60; ++k) {
      const double exposure = k / 30.;
      Body then = start;
      then.p += exposure * start.v;
      then.R = vpSO3::exp(exposure * start.w) * start.R;
      REQUIRE(tracks.add(then.seen(exposure, rng)));
      tracks.advance(exposure + 0.05);
    }
    const vpObjectTrack &track = tracks.tracks().front();
    const double now = 59. / 30. + 0.05;
    CHECK(track.age == Approx(0.05));
    CHECK_FALSE(track.resting);
    CHECK((track.pose.p - start.p - now * start.v).norm() < 4.5 * track.positionSigma);
    CHECK(track.positionSigma < 0.005); // where it was lies 20 mm off
    CHECK((linear(track) - start.v).norm() < 4.5 * track.velocitySigma);
    CHECK(vpSO3::log(track.pose.R * (vpSO3::exp(now * start.w) * start.R).transpose()).norm() < 4.5 * track.angleSigma);
    CHECK((angular(track) - start.w).norm() < 0.5);
  }
}

TEST_CASE("An object that hides for half a second moves on, grows, and is the same one after", "[tracks]")
{
  auto rng = vpTestSupport::generator(704);
  CAPTURE(vpTestSupport::seed());
  for (int run = 0; run < 20; ++run) {
    Body body;
    body.v = 0.3 * point(rng, 1.).normalized();
    vpObjectTracks tracks;
    watch(tracks, body, 0., 1., rng);
    const vpObjectTrack before = tracks.tracks().front();
    double last = before.inflation;
    for (double t = 1.01; t < 1.44; t += 0.01) {
      tracks.advance(t);
      const vpObjectTrack &track = tracks.tracks().front();
      CHECK(track.status == (track.age <= 0.15 ? vpTrackStatus::Tracked : vpTrackStatus::Coasting));
      CHECK((track.pose.p - body.p - (t - 1.) * body.v).norm() < 4.5 * track.positionSigma);
      CHECK(track.inflation >= last);
      CHECK(track.confidence < before.confidence);
      last = track.inflation;
    }
    tracks.advance(1.6);
    const vpObjectTrack &lost = tracks.tracks().front();
    CHECK(lost.status == vpTrackStatus::Lost);
    CHECK(linear(lost).norm() == 0.);
    const Vector3d stays = lost.pose.p;
    tracks.advance(2.5);
    CHECK((tracks.tracks().front().pose.p - stays).norm() == 0.);
    CHECK(tracks.tracks().front().inflation == vpObjectTrackSpec().maxInflation);
    vpObjectTracks seen = tracks;
    body.p += 1.5 * body.v;
    REQUIRE(seen.add(body.seen(2.5, rng)));
    CHECK(seen.tracks().front().restarts == 0);
    CHECK(seen.tracks().front().status == vpTrackStatus::Tracked);
    CHECK(seen.tracks().front().confidence > tracks.tracks().front().confidence);
  }
}

TEST_CASE("Sightings that cannot be true move nothing", "[tracks]")
{
  auto rng = vpTestSupport::generator(705);
  CAPTURE(vpTestSupport::seed());
  Body body;
  body.v = Vector3d(0.2, -0.1, 0.1);
  vpObjectTracks clean, dirty;
  int outliers = 0;
  double worst = 0.;
  for (int k = 0; k < 600; ++k) {
    const double t = k / 30.;
    vpObjectSighting sighting = body.seen(t, rng);
    CHECK(clean.add(sighting));
    const bool isOutlier = k > 10 && uniform(rng, 0., 1.) < 0.1;
    if (isOutlier) {
      ++outliers;
      if (k % 2 == 0) {
        sighting.pose.p += 0.3 * point(rng, 1.).normalized();
      }
      else {
        sighting.pose.R = vpSO3::exp(point(rng, 1.).normalized()) * sighting.pose.R;
      }
      const double before = dirty.tracks().front().confidence;
      CHECK_FALSE(dirty.add(sighting));
      CHECK(dirty.tracks().front().confidence < before);
    }
    else {
      CHECK(dirty.add(sighting));
    }
    clean.advance(t);
    dirty.advance(t);
    worst = std::max(worst, (dirty.tracks().front().pose.p - body.p).norm());
    body.move(1. / 30., 0., 0., rng);
  }
  REQUIRE(outliers > 30);
  CHECK(dirty.tracks().front().restarts == 0);
  CHECK(worst < 0.02); // an outlier is 300 mm off
  CHECK((dirty.tracks().front().pose.p - clean.tracks().front().pose.p).norm() < 0.01);
}

TEST_CASE("An object that is somewhere else is believed after two sightings, with little confidence", "[tracks]")
{
  auto rng = vpTestSupport::generator(706);
  CAPTURE(vpTestSupport::seed());
  Body body;
  vpObjectTracks tracks;
  watch(tracks, body, 0., 1., rng);
  const double before = tracks.tracks().front().confidence;
  CHECK(before > 0.9);
  body.p = Vector3d(0.5, 0., 0.);
  CHECK_FALSE(tracks.add(body.seen(1., rng)));
  CHECK(tracks.tracks().front().pose.p.norm() < 0.01);
  SECTION("it stays there") { CHECK(tracks.add(body.seen(1.033, rng))); }
  SECTION("what is seen does not agree with itself, and is given in to late")
  {
    const double first = tracks.tracks().front().confidence;
    for (int k = 1; k < 7; ++k) {
      body.p.y() = k % 2 == 1 ? 0.4 : -0.4;
      CHECK_FALSE(tracks.add(body.seen(1. + 0.033 * k, rng)));
    }
    CHECK(tracks.tracks().front().confidence < 0.1 * first);
    CHECK(tracks.add(body.seen(1.24, rng)));
  }
  const vpObjectTrack &track = tracks.tracks().front();
  CHECK((track.pose.p - body.p).norm() < 0.02);
  CHECK(track.restarts == 1);
  CHECK(track.sightings == 1);
  CHECK(track.status == vpTrackStatus::New);
  CHECK(linear(track).norm() == 0.);
  CHECK(track.confidence <= 0.3);
}

TEST_CASE("What rests has velocity 0 and stands still; what creeps, swings or starts does not rest", "[tracks]")
{
  auto rng = vpTestSupport::generator(707);
  CAPTURE(vpTestSupport::seed());
  int frames = 0, moving = 0, turning = 0, uncertain = 0, creeping = 0, late = 0, swinging = 0;
  for (int run = 0; run < 20; ++run) {
    const double rate = run % 2 == 0 ? 30. : 10.;
    Body body;
    body.p = point(rng, 1.);
    body.R = pose(rng, 1.).R;
    vpObjectTracks tracks;
    const double settle = 0.8;
    watch(tracks, body, 0., settle, rng, rate);
    for (int k = 0; k < 200; ++k, ++frames) {
      watch(tracks, body, settle + k / rate, settle + (k + 1) / rate, rng, rate);
      const vpObjectTrack &track = tracks.tracks().front();
      moving += linear(track).norm() > 0. ? 1 : 0;
      turning += angular(track).norm() > 0. ? 1 : 0;
      uncertain += track.positionSigma > 0.002 / std::sqrt(8.) ? 1 : 0;
      CHECK((track.pose.p - body.p).norm() < 5. * track.positionSigma);
    }
    // It starts: known after at most three sightings.
    double t = settle + 200 / rate;
    body.v = 0.3 * point(rng, 1.).normalized();
    body.move(1. / rate, 0., 0., rng);
    watch(tracks, body, t, t + 3. / rate, rng, rate);
    CHECK_FALSE(tracks.tracks().front().resting);
    // Slow but steady, and back and forth.
    vpObjectTracks slow, swing;
    Body creep;
    creep.v = 0.05 * point(rng, 1.).normalized();
    creep.w = 0.2 * point(rng, 1.).normalized();
    for (int k = 0; k < 100; ++k, ++late) {
      watch(slow, creep, k / rate, (k + 1) / rate, rng, rate);
      creeping += slow.tracks().front().resting ? 1 : 0;
      Body swings;
      swings.p.x() = 0.03 * std::sin(2. * pi * 1.1 * k / rate);
      watch(swing, swings, k / rate, (k + 1) / rate, rng, rate);
      swinging += swing.tracks().front().resting ? 1 : 0;
    }
  }
  CHECK(moving < 0.02 * frames);
  CHECK(turning < 0.02 * frames);
  CHECK(uncertain < 0.2 * frames);
  CHECK(creeping < 0.02 * late);
  CHECK(swinging < 0.05 * late); // where it turns
}

TEST_CASE("A table forgets, does not go back in time, and leaves broken sightings out", "[tracks]")
{
  auto rng = vpTestSupport::generator(708);
  vpObjectTracks tracks;
  Body body;
  watch(tracks, body, 0., 0.5, rng);
  const vpObjectTrack before = tracks.tracks().front();
  tracks.advance(0.1);
  tracks.advance(std::nan(""));
  CHECK(tracks.tracks().front().age == before.age);
  CHECK_FALSE(tracks.add(body.seen(0.2, rng)));
  vpObjectSighting broken = body.seen(0.6, rng);
  SECTION("no name") { broken.name.clear(); }
  SECTION("no time") { broken.time = std::nan(""); }
  SECTION("no place") { broken.pose.p.x() = std::numeric_limits<double>::infinity(); }
  SECTION("no rotation") { broken.pose.R *= 1.1; }
  SECTION("mirrored") { broken.pose.R.col(0) *= -1.; }
  SECTION("no noise") { broken.positionSigma = 0.; }
  SECTION("no noise of the rotation") { broken.angleSigma = -1.; }
  CHECK_FALSE(tracks.add(broken));
  REQUIRE(tracks.tracks().size() == 1);
  CHECK(tracks.tracks().front().sightings == before.sightings);
  CHECK(tracks.find("body") != nullptr);
  CHECK(tracks.find("nobody") == nullptr);
  tracks.advance(before.age + 0.49 + 4.9);
  CHECK(tracks.tracks().size() == 1);
  tracks.advance(5.6);
  CHECK(tracks.tracks().empty());
  CHECK(tracks.add(body.seen(5.6, rng)));
  CHECK(tracks.tracks().front().status == vpTrackStatus::New);
}

TEST_CASE("Tracks come into a scene and go, and what was there before stays", "[tracks]")
{
  auto rng = vpTestSupport::generator(709);
  vpCollisionSceneSpec spec;
  for (const char *name : {"table", "known"}) {
    vpCollisionObject object;
    object.name = name;
    object.pose.p = Vector3d(2., 0., name[0] == 't' ? 0. : 1.);
    spec.objects.push_back(object);
  }
  vpCollisionScene scene(amor(), spec);
  vpObjectTracks tracks;
  Body body;
  body.p = Vector3d(0.7, 0.1, 0.3);
  body.v = Vector3d(0.2, 0., 0.);
  for (int k = 0; k < 30; ++k) {
    vpObjectSighting sighting = body.seen(k / 30., rng);
    tracks.add(sighting);
    sighting.name = "known";
    tracks.add(sighting);
    tracks.advance(k / 30. + 0.01);
    CHECK(tracks.applyTo(scene) == (k == 0));
    REQUIRE(scene.objectCount() == 3);
    for (const vpObjectTrack &track : tracks.tracks()) {
      const vpCollisionObject &object = scene.object(scene.find(track.name));
      CHECK(object.pose.p == track.pose.p);
      CHECK(object.pose.R == track.pose.R);
      CHECK(object.inflation == track.inflation);
      CHECK(object.velocity[0] == track.velocity[0]);
      CHECK(object.shape.size() == track.shape.size());
    }
    body.move(1. / 30., 0., 0., rng);
  }
  CHECK(scene.object(scene.find("table")).pose.p == Vector3d(2., 0., 0.));

  // The queries know: a capsule of the arm finds the object where the track has it.
  vpCollisionData data;
  scene.place(vpJointVector::Zero(7), data);
  vpCollisionSceneSpec same;
  for (int i = 0; i < scene.objectCount(); ++i) {
    same.objects.push_back(scene.object(i));
  }
  CHECK(scene.clearance(data).distance ==
        Approx(vpCollisionScene(amor(), same).clearance(data).distance).margin(1e-12));

  // Another shape, and then nothing for long.
  vpObjectSighting other = body.seen(1., rng);
  other.shape = vpCollisionShape::sphere(0.07);
  REQUIRE(tracks.add(other));
  tracks.advance(1.01);
  CHECK(tracks.applyTo(scene));
  CHECK(scene.object(scene.find("body")).shape.radius() == 0.07);
  CHECK_FALSE(tracks.applyTo(scene));
  tracks.advance(20.);
  CHECK(tracks.tracks().empty());
  CHECK(tracks.applyTo(scene));
  CHECK(scene.find("body") < 0);
  REQUIRE(scene.find("known") >= 0); // it is known to exist
  CHECK(scene.object(scene.find("known")).velocity[0] == 0.);
  CHECK(scene.object(scene.find("known")).shape.type() == vpShapeType::Box);
  CHECK(scene.find("table") >= 0);
  CHECK_FALSE(tracks.applyTo(scene));
}

TEST_CASE("A cycle without news allocates nothing", "[tracks]")
{
  if (!vpTestSupport::canCountAllocations()) {
    vpTestSupport::skip("allocations cannot be counted in this build");
    return;
  }
  auto rng = vpTestSupport::generator(710);
  vpCollisionScene scene(amor());
  vpObjectTracks tracks;
  Body body;
  body.v = Vector3d(0.1, 0., 0.);
  watch(tracks, body, 0., 1., rng);
  tracks.applyTo(scene);
  const vpObjectSighting sighting = body.seen(1., rng);
  const unsigned long before = vpTestSupport::allocationCount();
  const bool used = tracks.add(sighting);
  for (int k = 0; k < 100; ++k) {
    tracks.advance(1. + 0.005 * k);
    tracks.applyTo(scene);
  }
  CHECK(vpTestSupport::allocationCount() == before);
  CHECK(used);
}

TEST_CASE("Parameters out of range are named with their values", "[tracks]")
{
  const auto message = [](const auto &change) {
    vpObjectTrackSpec spec;
    change(spec);
    try {
      static_cast<void>(vpObjectTracks(spec));
    }
    catch (const vpException &error) {
      return error.getStringMessage();
    }
    return std::string();
  };
  CHECK(message([](vpObjectTrackSpec &s) { s.acceleration = 0.; }) ==
        "acceleration of the object tracks is 0 m/s^2, must be > 0");
  CHECK(message([](vpObjectTrackSpec &s) { s.doubts = 0; }) == "doubts of the object tracks is 0, must be >= 1");
  CHECK(message([](vpObjectTrackSpec &s) { s.coast = -1.; }) == "coast of the object tracks is -1 s, must be >= 0");
  CHECK(message([](vpObjectTrackSpec &s) { s.forget = std::nan(""); }) ==
        "forget of the object tracks is nan, must be > 0 s");
  CHECK(message([](vpObjectTrackSpec &s) { s.forget = std::numeric_limits<double>::infinity(); }).empty());
}
