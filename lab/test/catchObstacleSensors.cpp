/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Sightings and tracks from rendered photographs of the true scene (eye in hand): errors match the reported sigmas.
#include "vpCatch.h"
#include "vpTestArms.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/io/vpImageIo.h>
#include "lab/avoidance/vpCameraObstacleSensors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <deque>
#include <iostream>

using namespace vpTestArms;
using Eigen::Vector3d;

namespace
{
struct Box {
  const char *name;
  const char *file;
  Vector3d size;
};
const Box boxes[3] = {{"klimt", "klimt.jpg", {0.16, 0.16, 0.05}},
                      {"starry-night", "starry-night.jpg", {0.2, 0.16, 0.08}},
                      {"box", "box.png", {0.16, 0.11, 0.03}}};

const vpSceneCameraSpec &cameraSpec()
{
  static const vpSceneCameraSpec spec = [] {
    vpSceneCameraSpec result;
    for (const Box &box : boxes) {
      vpScenePhoto photo;
      photo.object = box.name;
      photo.size = box.size.head<2>();
      vpImageIo::read(photo.image, std::string(VISP_DIRECT_DATA_DIR) + "/target/" + box.file);
      result.photos.push_back(photo);
    }
    return result;
  }();
  return spec;
}

vpObstacleDetector detector()
{
  vpPlanarTargetDatabase targets(cameraSpec().camera, vpObstacleDetector::fastTargets());
  for (const vpScenePhoto &photo : cameraSpec().photos) {
    const Box &box =
        *std::find_if(std::begin(boxes), std::end(boxes), [&](const Box &b) { return photo.object == b.name; });
    targets.add(box.name, photo.image, box.size.x(), box.size.y(), box.size.z());
  }
  return vpObstacleDetector(std::move(targets), cameraSpec().camera);
}

vpJointVector home()
{
  vpJointVector q(7);
  q << .246, .868, -1.237, -2.390, -2.591, -1.099, .324;
  return q;
}

vpRigidTransform cameraAt(const vpJointVector &q)
{
  vpArmData data;
  vpArmKinematics::forward(amor(), q, data);
  return vpArmKinematics::camera(amor(), data);
}

//! Beside each other in the view of a camera, tilted at random.
vpCollisionScene inView(const vpRigidTransform &fMc, std::mt19937_64 &rng, double tilt = 0.6)
{
  const double x[3] = {-0.15, 0.13, -0.06}, y[3] = {-0.09, -0.10, 0.13};
  vpCollisionSceneSpec spec;
  for (int i = 0; i < 3; ++i) {
    vpCollisionObject object;
    object.name = boxes[i].name;
    object.shape = vpCollisionShape::box(boxes[i].size);
    const Vector3d turn(uniform(rng, -tilt, tilt), uniform(rng, -tilt, tilt), uniform(rng, -0.5, 0.5));
    object.pose = fMc * vpRigidTransform{vpSO3::exp(turn), Vector3d(x[i], y[i], uniform(rng, 0.55, 0.75))};
    spec.objects.push_back(object);
  }
  return vpCollisionScene(amor(), spec);
}

vpImageObstacleSensor sensor(double noise, double blur, unsigned int seed)
{
  vpImageObstacleSensorSpec spec;
  spec.faults.noise = noise;
  spec.faults.blur = blur;
  spec.seed = seed;
  return vpImageObstacleSensor(vpSceneCamera(cameraSpec()), detector(), spec);
}

struct Frame {
  double shown;
  std::vector<vpObjectSighting> sightings;
};
} // namespace

TEST_CASE("Errors of sightings from rendered pictures are as large as they say", "[sensor]")
{
  auto rng = vpTestSupport::generator(741);
  CAPTURE(vpTestSupport::seed());
  const vpJointVector q = home();
  int seen = 0, wild = 0, far = 0;
  double places = 0., turns = 0.;
  for (int problem = 0; problem < 12; ++problem) {
    const vpCollisionScene truth = inView(cameraAt(q), rng);
    vpCollisionData arm;
    truth.place(q, arm);
    vpImageObstacleSensor eye =
        sensor(uniform(rng, 0., 8.), uniform(rng, 0., 1.2), 100 * vpTestSupport::seed() + problem);
    std::vector<vpObjectSighting> sightings;
    eye.look(truth, arm, 0.5, sightings);
    for (const vpObjectSighting &sighting : sightings) {
      const vpCollisionObject &object = truth.object(truth.find(sighting.name));
      const double place = (sighting.pose.p - object.pose.p).norm() / sighting.positionSigma;
      const double turn = vpSO3::log(sighting.pose.R * object.pose.R.transpose()).norm() / sighting.angleSigma;
      CHECK(sighting.shape.size() == object.shape.size());
      CHECK(sighting.time == 0.5);
      ++seen;
      if (turn > 10.) {
        ++wild; // the other one of the two poses that a small plane may have
        continue;
      }
      far += place > 3. || turn > 4. ? 1 : 0;
      places += place * place;
      turns += turn * turn;
    }
  }
  CAPTURE(seen, wild, far, places / seen, turns / seen);
  // Of 36; small and oblique ones are refused: 30.2 +- 3.7 over 24 seeds, the three of a picture together.
  CHECK(seen >= 15);
  CHECK(wild <= 2);
  CHECK(far <= 3);
  std::cout << "sightings: " << seen << " of 36, wrong " << wild << ", error over deviation, rms: place "
            << std::sqrt(places / (seen - wild)) << ", rotation " << std::sqrt(turns / (seen - wild)) << std::endl;
  // The worst direction represents all three: between one and three squares each, and noise of the camera position. A
  // standard deviation three times too large or too small would be detected.
  const double count = seen - wild;
  CHECK(std::sqrt(places / count) < 2.);
  CHECK(std::sqrt(places / count) > 0.2);
  CHECK(std::sqrt(turns / count) < 2.);
  CHECK(std::sqrt(turns / count) > 0.3);
}

TEST_CASE("Pictures that come late, from a camera that moves, become tracks of what rests and of what moves",
          "[sensor]")
{
  auto rng = vpTestSupport::generator(742);
  CAPTURE(vpTestSupport::seed());
  vpJointVector q = home();
  vpCollisionScene truth = inView(cameraAt(q), rng, 0.3);
  vpCollisionData arm;
  vpImageObstacleSensor eye = sensor(2., 0.5, vpTestSupport::seed());
  vpObjectTracks tracks;
  std::deque<Frame> onTheWay;
  const Vector3d v = 0.12 * (truth.object(0).pose.R * Vector3d(-0.6, 0.3, 1.)).normalized(); // sideways and away
  REQUIRE(truth.setVelocity(0, vpTwist(v.x(), v.y(), v.z(), 0., 0., 0.)));
  int checked = 0, outside = 0, resting = 0, unseen = 0;
  double worst = 0.;
  constexpr double period = 1. / 30., latency = 0.05;
  for (int k = 0; k < 45; ++k) {
    const double now = k * period;
    truth.place(q, arm);
    Frame frame{now + latency, {}};
    eye.look(truth, arm, now, frame.sightings);
    onTheWay.push_back(frame);
    while (!onTheWay.empty() && onTheWay.front().shown <= now + 1e-9) {
      for (const vpObjectSighting &sighting : onTheWay.front().sightings) {
        tracks.add(sighting);
      }
      onTheWay.pop_front();
    }
    tracks.advance(now);
    for (int i = 0; i < 3 && k >= 20; ++i) {
      const vpObjectTrack *track = tracks.find(boxes[i].name);
      if (track == nullptr) {
        ++unseen;
        continue;
      }
      ++checked;
      const double error = (track->pose.p - truth.object(i).pose.p).norm();
      outside += error > track->inflation ? 1 : 0;
      worst = std::max(worst, error);
      const Vector3d speed(track->velocity[0], track->velocity[1], track->velocity[2]);
      if (i == 0) {
        CHECK((speed - v).norm() < 0.08);
        CHECK_FALSE(track->resting);
      }
      else {
        resting += speed.norm() == 0. ? 1 : 0;
      }
      CHECK(track->restarts == 0);
    }
    truth.advance(period);
    q(0) += 0.1 * period; // the camera goes about the base
    q(3) += 0.1 * period;
  }
  CHECK(unseen == 0);
  CHECK(outside == 0);
  CHECK(worst < 0.012);
  CHECK(resting >= 0.8 * 50);
  CHECK(checked == 75);
}

TEST_CASE("A covered camera sees nothing; what it has seen is still there", "[sensor]")
{
  auto rng = vpTestSupport::generator(743);
  CAPTURE(vpTestSupport::seed());
  const vpJointVector q = home();
  const vpCollisionScene truth = inView(cameraAt(q), rng, 0.3);
  vpCollisionScene perceived(amor());
  vpCollisionData arm;
  truth.place(q, arm);
  vpImageObstacleSensor eye = sensor(1., 0.5, 5);
  vpObjectTracks tracks;
  std::vector<vpObjectSighting> sightings;
  for (int k = 0; k < 30; ++k) {
    eye.cover(k >= 12 && k < 24);
    eye.look(truth, arm, k / 30., sightings);
    CHECK(sightings.size() == (k >= 12 && k < 24 ? 0 : 3));
    for (const vpObstacleDetection &detection : eye.detector().detections()) {
      CHECK(detection.seen != (k >= 12 && k < 24));
      CHECK_FALSE(detection.message.empty());
    }
    for (const vpObjectSighting &sighting : sightings) {
      tracks.add(sighting);
    }
    tracks.advance(k / 30.);
    tracks.applyTo(perceived);
    REQUIRE(perceived.objectCount() == 3);
    for (int i = 0; i < 3 && k > 2; ++i) {
      const vpCollisionObject &object = perceived.object(i);
      CHECK((object.pose.p - truth.object(truth.find(object.name)).pose.p).norm() < 0.02);
    }
  }
  for (const vpObjectTrack &track : tracks.tracks()) {
    CHECK(track.restarts == 0);
    CHECK(track.status == vpTrackStatus::Tracked);
  }
}

TEST_CASE("A depth camera maps what it sees, and the map comes into the scene", "[sensor][needs-OCTOMAP]")
{
  auto rng = vpTestSupport::generator(744);
  CAPTURE(vpTestSupport::seed());
  const vpJointVector q = home();
  const vpCollisionScene truth = inView(cameraAt(q), rng);
  vpCollisionScene perceived(amor());
  vpCollisionData arm;
  truth.place(q, arm);
  vpDepthObstacleSensorSpec spec;
  spec.map.stride = 4;
  spec.faults.noise = 0.002;
  vpDepthObstacleSensor eye(vpSceneCamera(cameraSpec()), spec);
  vpObjectTracks tracks;
  std::vector<vpObjectSighting> sightings;
  for (int k = 0; k < 10; ++k) {
    eye.look(truth, arm, 0.1 * k, sightings);
    REQUIRE(sightings.size() == 1);
    CHECK(eye.report().status == vpDepthStatus::Ok);
    CHECK(tracks.add(sightings[0]));
    tracks.advance(0.1 * k);
    tracks.applyTo(perceived);
  }
  REQUIRE(perceived.find("depth") == 0);
  const vpCollisionObject &map = perceived.object(0);
  CHECK(map.pose.p.norm() < 2e-3);
  CHECK(tracks.tracks()[0].resting);
  CHECK(map.inflation < 0.01);
  int on[3] = {0, 0, 0}, off = 0;
  for (const vpOctreeCell &cell : map.shape.octree().cells()) {
    bool isOn = false;
    for (int i = 0; i < 3; ++i) {
      const vpRigidTransform oMf = truth.object(i).pose.inverse();
      const Vector3d p = oMf.R * cell.centre + oMf.p;
      const double outside = (p.cwiseAbs() - 0.5 * truth.object(i).shape.size()).cwiseMax(0.).norm();
      if (outside < 0.9 * cell.size + 0.004) { // half a diagonal, and noise
        ++on[i];
        isOn = true;
      }
    }
    off += isOn ? 0 : 1;
  }
  for (const int cubes : on) {
    CHECK(cubes > 20);
  }
  CHECK(off <= 2);
}

TEST_CASE("Sensors that cannot work are refused", "[sensor][needs-OCTOMAP]")
{
  vpImageObstacleSensorSpec image;
  image.angleSigma = -1.;
  CHECK_THROWS_WITH(image.validate(), Catch::Contains("angleSigma of the obstacle sensor is -1 rad, must be >= 0"));
  image = vpImageObstacleSensorSpec();
  image.faults.blur = 9.;
  CHECK_THROWS_WITH(image.validate(), Catch::Contains("blur of the camera's faults is 9 px, must be 0..5"));
  vpDepthObstacleSensorSpec depth;
  depth.name.clear();
  CHECK_THROWS_WITH(depth.validate(), Catch::Contains("name of the depth sensor's sighting is empty"));
  depth = vpDepthObstacleSensorSpec();
  depth.map.resolution = 0.;
  CHECK_THROWS_WITH(vpDepthObstacleSensor(vpSceneCamera(cameraSpec()), depth),
                    Catch::Contains("resolution of the depth octomap is 0"));
}
