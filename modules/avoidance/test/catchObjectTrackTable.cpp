/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The table of tracks: what comes in, what goes out, and how a scene follows it.
#include "vpCatch.h"
#include "vpTrackTestKit.h"

#include <visp3/core/vpException.h>

using namespace vpTrackTestKit;

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
        "acceleration of the object tracks is 0, must be > 0 m/s^2 and finite");
  CHECK(message([](vpObjectTrackSpec &s) { s.doubts = 0; }) == "doubts of the object tracks is 0, must be >= 1");
  CHECK(message([](vpObjectTrackSpec &s) { s.coast = -1.; }) ==
        "coast of the object tracks is -1, must be >= 0 s and finite");
  CHECK(message([](vpObjectTrackSpec &s) { s.forget = std::nan(""); }) ==
        "forget of the object tracks is nan, must be > 0 s");
  CHECK(message([](vpObjectTrackSpec &s) { s.forget = std::numeric_limits<double>::infinity(); }).empty());
}
