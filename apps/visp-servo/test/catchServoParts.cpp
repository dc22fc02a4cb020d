/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The parts of visp-servo: rows between threads, files and what is read back, goals, settings, the picture.
#include "vpCatch.h"

#include "goal.h"
#include "liveRobot.h"
#include "numberText.h"
#include "reach.h"
#include "recording.h"
#include "recorded.h"
#include "options.h"
#include "target.h"
#include "view.h"

#include "testFolder.h"

#include <visp3/core/vpMath.h>
#include <visp3/core/vpPoseVector.h>
#include <visp3/direct_core/vpSO3.h>

#include <cmath>
#include <iostream>
#include <sstream>
#include <thread>

namespace
{
using namespace visualServo;
using vpTestSupport::uniform;
using Rng = std::mt19937_64;

Eigen::Vector3d vectorOf(Rng &rng, double size)
{
  return {uniform(rng, -size, size), uniform(rng, -size, size), uniform(rng, -size, size)};
}

vpRigidTransform poseOf(Rng &rng, double length, double angle)
{
  return {vpSO3::exp(vectorOf(rng, angle)), vectorOf(rng, length)};
}

double distance(const vpRigidTransform &a, const vpRigidTransform &b)
{
  return (a.p - b.p).norm() + vpSO3::log(a.R.transpose() * b.R).norm();
}

CycleRow rowOf(Rng &rng, double time)
{
  CycleRow row;
  row.time = time;
  row.status = uniform(rng, 0., 1.) < 0.2 ? vpVisualServoStatus::Idle : vpVisualServoStatus::Servoing;
  row.message = "The law moves the camera.";
  row.hasPose = uniform(rng, 0., 1.) < 0.8;
  row.cMo = poseOf(rng, 1., 1.5);
  row.positionError = row.hasPose ? uniform(rng, 0., 1.) : NOTHING;
  row.rotationError = row.hasPose ? uniform(rng, 0., 3.) : NOTHING;
  for (std::size_t i = 0; i < 6; ++i) {
    row.twist[i] = uniform(rng, -1., 1.);
  }
  row.hasCamera = true;
  row.fMc = poseOf(rng, 2., 1.5);
  return row;
}

vpImage<unsigned char> imageOf(Rng &rng, unsigned int width, unsigned int height)
{
  vpImage<unsigned char> image(height, width);
  for (unsigned int i = 0; i < image.getSize(); ++i) {
    image.bitmap[i] = static_cast<unsigned char>(uniform(rng, 0., 255.99));
  }
  return image;
}
} // namespace

TEST_CASE("rows pass from thread to thread in order; those without room are counted", "[visp-servo][queue]")
{
  constexpr int count = 200000;
  RowQueue queue(64);
  std::thread writer([&queue] {
    CycleRow row;
    for (int i = 0; i < count; ++i) {
      row.time = i;
      row.q[0] = 2. * i; // torn rows would differ
      queue.push(row);
    }
  });
  int read = 0;
  double last = -1.;
  bool isOrdered = true, isWhole = true;
  CycleRow row;
  const auto take = [&] {
    while (queue.pop(row)) {
      isOrdered = isOrdered && row.time > last;
      isWhole = isWhole && row.q[0] == 2. * row.time;
      last = row.time;
      ++read;
    }
  };
  while (last < count - 1 && read + static_cast<int>(queue.lost()) < count) {
    take();
  }
  writer.join();
  take();
  CHECK(isOrdered);
  CHECK(isWhole);
  CHECK(read + static_cast<int>(queue.lost()) == count);
}

TEST_CASE("a row is made without allocation", "[visp-servo][queue]")
{
  if (!vpTestSupport::canCountAllocations()) {
    vpTestSupport::skip("allocations cannot be counted in this build");
    return;
  }
  vpVisualServoSpec spec;
  spec.assumeExecuted = true;
  vpVisualServo servo(vpServoController::create("pbvs1"), spec);
  servo.step(vpServoRobotState(), 0.);
  RowQueue queue(4);
  const unsigned long before = vpTestSupport::allocationCount();
  queue.push(rowOf(servo, vpServoRobotState(), true, 0., 1e-5));
  CHECK(vpTestSupport::allocationCount() == before);
}

TEST_CASE("thinned rows are every 2^k-th of all", "[visp-servo][recording]")
{
  for (const int count : {0, 1, 9, 10, 11, 1000, 12345}) {
    Thinned<int> some(10);
    for (int i = 0; i < count; ++i) {
      some.add(i);
    }
    CAPTURE(count);
    CHECK(some.count() == static_cast<std::size_t>(count));
    CHECK(some.rows().size() < 10);
    CHECK((count < 10 ? some.rows().size() == static_cast<std::size_t>(count) : some.rows().size() >= 5));
    const int step = some.rows().size() < 2 ? 1 : some.rows()[1];
    CHECK((step & (step - 1)) == 0);
    for (std::size_t i = 0; i < some.rows().size(); ++i) {
      CHECK(some.rows()[i] == static_cast<int>(i) * step);
    }
  }
}

TEST_CASE("what is recorded is read back: rows to nine digits, images exactly", "[visp-servo][recording]")
{
  Rng rng = vpTestSupport::generator();
  const TestFolder folder;
  std::vector<CycleRow> rows;
  std::vector<vpImage<unsigned char>> images;
  vpApp::OutputFolder out("visp-servo", folder.file("out"));
  Recording recording(out, nullptr, 25.);
  for (int i = 0; i < 50; ++i) {
    rows.push_back(rowOf(rng, 0.005 * i));
    recording.add(rows.back());
    if (i % 5 == 0) {
      images.push_back(imageOf(rng, 64, 48));
      ImageRow row;
      row.capture = 0.005 * i - 0.002;
      row.seen = 0.005 * i;
      row.found = i % 2 == 0;
      row.cMo = poseOf(rng, 1., 1.).toHomogeneous();
      row.message = "A sentence, with \"quotes\".";
      recording.add(row, i == 20 ? nullptr : &images.back()); // one was not recorded
    }
  }
  recording.close();
  const std::filesystem::path place = std::filesystem::path(out.file("log.csv")).parent_path();
  std::size_t k = 0;
  readCycles(place, [&](const RecordedCycle &cycle) {
    const CycleRow &row = rows.at(k++);
    CHECK(cycle.time == Approx(row.time).epsilon(1e-8));
    CHECK(cycle.isIdle == (row.status == vpVisualServoStatus::Idle));
    CHECK(std::isnan(cycle.positionError) == std::isnan(row.positionError));
    CHECK(distance(cycle.fMc, row.fMc) < 1e-7);
    for (std::size_t i = 0; i < 6; ++i) {
      CHECK(std::fabs(cycle.twist[i] - row.twist[i]) < 1e-8);
    }
  });
  CHECK(k == rows.size());
  const std::vector<RecordedImage> read = readImages(place);
  REQUIRE(read.size() == images.size() - 1);
  cv::VideoCapture film((place / Recording::VIDEO).string(), cv::CAP_FFMPEG);
  for (std::size_t i = 0; i < read.size(); ++i) {
    CHECK(read[i].index == i);
    cv::Mat frame, grey;
    REQUIRE(film.read(frame));
    cv::extractChannel(frame, grey, 0);
    const vpImage<unsigned char> &image = images[i < 4 ? i : i + 1];
    CHECK(cv::norm(grey, cv::Mat(48, 64, CV_8UC1, image.bitmap), cv::NORM_INF) == 0.);
  }
}

TEST_CASE("a cut or damaged log is one sentence, a cut last line is left out", "[visp-servo][recording][errors]")
{
  const TestFolder folder;
  const std::string heading =
      "time_s,status,position_error_m,rotation_error_rad,fMc_tx,fMc_ty,fMc_tz,fMc_tux,fMc_tuy,fMc_tuz,v_x,"
      "v_y,v_z,v_wx,v_wy,v_wz\n";
  const std::string good = "0,Idle,,,1,2,3,0,0,0,0,0,0,0,0,0\n";
  const auto count = [&folder](const std::string &content) {
    folder.write("log.csv", content);
    int rows = 0;
    readCycles(folder.path, [&rows](const RecordedCycle &) { ++rows; });
    return rows;
  };
  CHECK(count(heading + good + good) == 2);
  CHECK(count(heading + good + good.substr(0, 12)) == 1);
  CHECK(count(heading) == 0);
  CHECK(complaint([&] { count("a,b\n1,2\n"); }) ==
        folder.file("log.csv") + ": has no column time_s, so it is no recording of visp-servo");
  CHECK(complaint([&] { count(heading + "x,Idle,,,1,2,3,0,0,0,0,0,0,0,0,0\n"); }) ==
        folder.file("log.csv") + ":2: time_s is \"x\", must be a number");
  CHECK(complaint([&] { count(heading + good + "1,Idle\n"); }) ==
        folder.file("log.csv") + ":3: has 2 fields, must have 16");
  CHECK(complaint([&] { (void)readImages(folder.path / "none"); }).find("images.csv: cannot be read") !=
        std::string::npos);
}

TEST_CASE("a taught goal is the mean of its poses, and refuses a camera that moved", "[visp-servo][teach]")
{
  Rng rng = vpTestSupport::generator();
  double meanError = 0., single = 0., told = 0.;
  constexpr int problems = 200;
  for (int k = 0; k < problems; ++k) {
    vpRigidTransform truth = poseOf(rng, 0.1, 1.);
    truth.p.z() = uniform(rng, 0.3, 1.);
    std::vector<vpHomogeneousMatrix> poses;
    std::normal_distribution<double> noise(0., 1e-4);
    for (int i = 0; i < 25; ++i) {
      const vpRigidTransform error{vpSO3::exp({noise(rng), noise(rng), noise(rng)}),
                                   {noise(rng), noise(rng), noise(rng)}};
      poses.push_back(vpRigidTransform{error.R * truth.R, truth.p + error.p}.toHomogeneous());
    }
    const Goal goal = meanGoal(poses);
    CHECK(goal.images == 25);
    meanError += std::pow(distance(vpRigidTransform::fromHomogeneous(goal.cdMo), truth), 2) / problems;
    single += std::pow(distance(vpRigidTransform::fromHomogeneous(poses[0]), truth), 2) / problems;
    told += goal.positionSpread / problems;
    const Goal again = [&] {
      const TestFolder folder;
      return readGoal(folder.write("goal.json", goalText(goal)));
    }();
    CHECK(distance(vpRigidTransform::fromHomogeneous(again.cdMo), vpRigidTransform::fromHomogeneous(goal.cdMo)) <
          1e-12);

    // A camera that drifts by 2 % of the distance meanwhile.
    for (std::size_t i = 0; i < poses.size(); ++i) {
      poses[i][0][3] += 0.04 * truth.p.z() * static_cast<double>(i) / 24.;
    }
    CHECK(complaint([&] { (void)meanGoal(poses); }).find("moved while the goal was taught") != std::string::npos);
  }
  CHECK(std::sqrt(single / meanError) == Approx(5.).epsilon(0.15)); // sqrt(25)
  CHECK(told == Approx(std::sqrt(3.) * 1e-4).epsilon(0.05));
  CHECK(complaint([] { (void)meanGoal({}); }) == "the target was found in 0 of the images, a goal needs at least 2");
}

TEST_CASE("a wrong goal file names the field and its value", "[visp-servo][teach][errors]")
{
  const TestFolder folder;
  const auto said = [&folder](const std::string &content) {
    const std::string file = folder.write("goal.json", content);
    return complaint([&] { (void)readGoal(file); }).substr(file.size());
  };
  CHECK(said("{\"position_m\": [0, 0], \"rotation_deg\": [0, 0, 0]}") ==
        ": position_m is [0,0], must be a list of 3 numbers");
  CHECK(said("{\"position_m\": [0, 0, -1], \"rotation_deg\": [0, 0, 0]}").find(": position_m[2] is -1, must be > 0") ==
        0);
  CHECK(said("{\"position_m\": [0, 0, 1]}").find("rotation_deg") != std::string::npos);
  CHECK(said("{\"position_m\": [0, 0, 1], \"rotation_deg\": [0, 0, 0], \"positon\": 1}").find("positon") !=
        std::string::npos);
  CHECK(said("{").find("line 1") != std::string::npos);
}

TEST_CASE("recorded settings give the same options again, unless others are given", "[visp-servo][settings]")
{
  Rng rng = vpTestSupport::generator();
  const auto read = [](std::vector<std::string> arguments) {
    std::vector<const char *> argv{"visp-servo"};
    for (const std::string &argument : arguments) {
      argv.push_back(argument.c_str());
    }
    Options options;
    REQUIRE(readOptions(static_cast<int>(argv.size()), argv.data(), options));
    return options;
  };
  const TestFolder folder;
  const vpServoMotionLimits usual, slow = read({"--max-acceleration", "0.1"}).law.motion;
  CHECK(slow.linearVelocity == 0.05); // as the manual says
  CHECK(slow.angularAcceleration == Approx(0.1 / usual.linearAcceleration * usual.angularAcceleration));
  CHECK(slow.linearJerk == Approx(0.1 / usual.linearAcceleration * usual.linearJerk));
  CHECK(slow.angularJerk == Approx(0.1 / usual.linearAcceleration * usual.angularJerk));
  CHECK(read({"--tolerance", "2,90"}).servo.positionTolerance == Approx(0.002));
  CHECK(read({"--tolerance", "2,90"}).servo.rotationTolerance == Approx(0.5 * M_PI));
  for (int k = 0; k < 50; ++k) {
    const auto text = [&rng](double low, double high) { return std::to_string(uniform(rng, low, high)); };
    std::vector<std::string> given{
        "--law",          "ff-sum,pbvs1",   "--lambda",     text(0.1, 5.),        "--max-linear",
        text(0.01, 1.),   "--max-angular",  text(0.01, 1.), "--max-acceleration", text(0.1, 2.),
        "--control-rate", text(50., 1000.), "--start-time", text(0., 2.),         "--image-timeout",
        text(0.1, 1.),    "--size",         text(0.1, 1.),  "--tolerance",        text(0.1, 5.) + "," + text(0.1, 5.)};
    given.push_back(k % 2 == 0 ? "--eye-to-hand" : "--moving-target");
    const Options first = read(given);
    const vpHomogeneousMatrix goal = poseOf(rng, 0.2, 1.).toHomogeneous() * vpHomogeneousMatrix(0., 0., 1., 0., 0., 0.);
    folder.write(SETTINGS_FILE, settingsText(settingsOf(first, goal)));
    const std::string place = folder.path.string();
    if (goal[2][3] <= 0.) {
      continue;
    }
    const Options again = read({"--replay", place});
    CHECK(again.laws == first.laws);
    CHECK(again.law.gains.lambda == Approx(first.law.gains.lambda).epsilon(1e-7));
    CHECK(again.law.motion.linearVelocity == Approx(first.law.motion.linearVelocity).epsilon(1e-7));
    CHECK(again.law.motion.angularJerk == Approx(first.law.motion.angularJerk).epsilon(1e-7));
    CHECK(again.servo.period == Approx(first.servo.period).epsilon(1e-7));
    CHECK(again.servo.rotationTolerance == Approx(first.servo.rotationTolerance).epsilon(1e-7));
    CHECK(again.target.width == Approx(first.target.width).epsilon(1e-7));
    CHECK(again.servo.startTime == Approx(first.servo.startTime).epsilon(1e-7));
    CHECK(again.servo.imageTimeout == Approx(first.servo.imageTimeout).epsilon(1e-7));
    CHECK(again.servo.positionTolerance == Approx(first.servo.positionTolerance).epsilon(1e-7));
    CHECK(again.camera.isFixed == (k % 2 == 0));
    CHECK(again.camera.fMc == (k % 2 == 0 ? place + "/" + FIXED_CAMERA_FILE : ""));
    CHECK(again.servo.objectMoves == (k % 2 == 1));
    CHECK(again.target.photo == place + "/target.png");
    REQUIRE(again.target.goalPose);
    CHECK(distance(vpRigidTransform::fromHomogeneous(*again.target.goalPose), vpRigidTransform::fromHomogeneous(goal)) <
          1e-9);
    const Options other = read({"--replay=" + place, "--law", "ff-lookat", "--target", "mine.png", "--size=0.3"});
    CHECK(other.laws == std::vector<std::string>{"ff-lookat"});
    CHECK(other.target.photo == "mine.png");
    CHECK(other.target.width == 0.3);
    CHECK(!other.target.goalPose); // the goal was that of the other target
    CHECK(other.law.gains.lambda == Approx(first.law.gains.lambda).epsilon(1e-7));
  }
  const Options first = read({"--reference", "image.png", "--distance", "0.3,0.9"}); // of unknown size
  folder.write(SETTINGS_FILE, settingsText(settingsOf(first, vpHomogeneousMatrix())));
  const Options again = read({"--replay", folder.path.string()});
  CHECK(again.target.reference == folder.file("reference.png"));
  CHECK(again.target.nearest == 0.3);
  CHECK(again.target.farthest == 0.9);
}

TEST_CASE("the picture shows target and goal where the camera has them", "[visp-servo][view]")
{
  Rng rng = vpTestSupport::generator();
  for (const unsigned int width : {320U, 640U, 1000U}) {
    const unsigned int height = 3 * width / 4;
    const double f = 0.9 * width;
    const vpCameraParameters camera(f, f, 0.5 * (width - 1.), 0.5 * (height - 1.));
    View view(camera, width, height, vpServoMotionLimits());
    const vpImage<unsigned char> image(height, width, 100);
    const double scale = width < 640 ? 2. : 1.;
    for (int k = 0; k < 20; ++k) {
      ImageRow seen;
      seen.found = true;
      seen.capture = 10. * k; // no trail
      for (const auto &corner : {std::pair<double, double>{-1., -1.}, {1., -1.}, {1., 1.}, {-1., 1.}}) {
        vpServoPoint point;
        point.x = 0.2 * corner.first + uniform(rng, -0.1, 0.1);
        point.y = 0.15 * corner.second + uniform(rng, -0.05, 0.05);
        seen.outline.push_back(point);
      }
      CycleRow cycle;
      Moment moment{};
      moment.image = &image;
      moment.seen = &seen;
      moment.cycle = &cycle;
      const cv::Mat picture = view.draw(moment, true);
      CHECK(picture.cols % 2 == 0);
      CHECK(picture.rows % 2 == 0);
      for (std::size_t i = 0; i < 4; ++i) { // the middle of each side is green, the centre is not
        const vpServoPoint &a = seen.outline[i], &b = seen.outline[(i + 1) % 4];
        const double u = f * 0.5 * (a.x + b.x) + 0.5 * (width - 1.), v = f * 0.5 * (a.y + b.y) + 0.5 * (height - 1.);
        const auto pixel = picture.at<cv::Vec3b>(static_cast<int>(std::lround(scale * (v + 0.5) - 0.5)),
                                                 static_cast<int>(std::lround(scale * (u + 0.5) - 0.5)));
        CHECK(pixel[1] > 150);
        CHECK(pixel[0] < 120);
      }
      const auto centre =
          picture.at<cv::Vec3b>(static_cast<int>(scale * height / 2), static_cast<int>(scale * width / 2));
      CHECK(centre == cv::Vec3b(100, 100, 100));
    }
  }
}

TEST_CASE("joints that do not move the camera are named, and --eMc puts it into the end effector",
          "[visp-servo][robot]")
{
  const TestFolder folder;
  std::ifstream amor(VISP_DIRECT_DATA_DIR "/robot/amor.json");
  std::string text{std::istreambuf_iterator<char>(amor), {}};
  const std::string key = "\"camera\": {";
  text.insert(text.find(key) + key.size(), "\"link\": 5, ");
  Options options;
  options.motion.robot.robot = folder.write("arm.json", text);
  std::ostringstream told;
  const auto load = [&] {
    std::streambuf *before = std::cerr.rdbuf(told.rdbuf());
    const vpArmModel model = loadModel(options);
    std::cerr.rdbuf(before);
    return model;
  };
  CHECK(load().cameraLink() == 5);
  CHECK_THAT(told.str(), Catch::Contains(": the camera is on link 5, not moved by q6 and q7\n"));
  options.camera.isFixed = true;
  told.str("");
  CHECK(load().cameraLink() == 5);
  CHECK(told.str().empty()); // the target is on the end effector, which all joints move
  options.camera.isFixed = false;
  options.motion.eMc = folder.write("eMc.txt", "0.01\n-0.02\n0.03\n0.1\n0.2\n-0.3\n");
  const vpArmModel mounted = load();
  CHECK(told.str().empty());
  CHECK(mounted.cameraLink() == mounted.toolLink());
  vpArmData data;
  vpArmKinematics::update(mounted, mounted.home(), data);
  const vpRigidTransform eMc = data.tool.inverse() * vpArmKinematics::camera(mounted, data);
  CHECK(distance(eMc, vpRigidTransform::fromHomogeneous(
                          vpHomogeneousMatrix(vpPoseVector(0.01, -0.02, 0.03, 0.1, 0.2, -0.3)))) < 1e-12);
}

TEST_CASE(
    "what hinders an arm: limits by name, a goal beyond its reach, nothing where random joint positions are the goal",
    "[visp-servo][robot]")
{
  const bool isFixed = GENERATE(false, true);
  CAPTURE(isFixed);
  Rng rng(vpTestSupport::seed());
  Options options;
  options.motion.robot.robot = "amor";
  const vpArmModel arm = loadModel(options);
  const auto random = [&] { // inside of the limits
    vpJointVector q(arm.size());
    for (int j = 0; j < arm.size(); ++j) {
      const double margin = 0.05 * (arm.upper()(j) - arm.lower()(j));
      q(j) =
          arm.isContinuous(j) ? uniform(rng, -3., 3.) : uniform(rng, arm.lower()(j) + margin, arm.upper()(j) - margin);
    }
    return q;
  };
  const vpRigidTransform fMc = poseOf(rng, 2., 1.5);
  vpArmData data;
  const auto placeOf = [&](const vpJointVector &q) {
    vpArmKinematics::update(arm, q, data);
    return isFixed ? data.tool : vpArmKinematics::camera(arm, data);
  };
  for (int run = 0; run < 10; ++run) {
    const vpJointVector from = random(), to = random();
    const vpRigidTransform start = placeOf(from), end = placeOf(to), fMo = poseOf(rng, 2., 1.5),
                           eMo = poseOf(rng, 0.2, 1.5);
    const vpRigidTransform cMo = isFixed ? fMc.inverse() * start * eMo : start.inverse() * fMo;
    const vpRigidTransform cdMo = isFixed ? fMc.inverse() * end * eMo : end.inverse() * fMo;
    const vpRigidTransform place = placeAtGoal(isFixed, fMc, start, cMo, cdMo);
    CHECK(distance(place, end) < 1e-9);
    CHECK(hindrances(arm, from, place, isFixed).empty());
    const vpRigidTransform beyond{place.R, Eigen::Vector3d(uniform(rng, 2., 9.), 0., 0.)};
    const std::vector<std::string> told = hindrances(arm, from, beyond, isFixed);
    REQUIRE(told.size() == 1);
    CHECK_THAT(told[0], Catch::StartsWith("no joint positions were found that reach the goal, "));
  }
  vpJointVector q = random();
  q(1) = arm.upper()(1);
  CHECK(hindrances(arm, q, placeOf(q), isFixed) ==
        std::vector<std::string>{"joint q2 is at its upper limit " + vpApp::number(arm.upper()(1), 4)});
}
