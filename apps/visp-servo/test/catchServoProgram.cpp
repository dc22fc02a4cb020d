/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-servo as it is run by users: the simulation, replay, teaching, recorded images, plug-ins, and its ends.
#include "vpCatch.h"

#include "programRun.h"

#include "recorded.h"

#include <visp3/avoidance/vpCollisionScene.h>
#include <visp3/core/vpIoTools.h>
#include <visp3/core/vpMath.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/manipulator/vpArmJson.h>
#include <visp3/rendering/vpPlaneRenderer.h>
#include <visp3/servoing/vpServoCalibration.h>

#include <nlohmann/json.hpp>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

#include <csignal>
#include <sys/types.h>
#include <unistd.h>

namespace
{
using nlohmann::json;
const bool s_quick = withoutReports();
constexpr int OK = 0, DATA = 1;
// Near the goal, so that runs are short.
const std::string NEAR = " --object-pose 0.004,-0.003,0.305,1,-1,1 --start-time 0.2 --lambda 3";

json summaryIn(const ProgramRun &run, const std::string &folder)
{
  return json::parse(vpApp::readFile(run.path(folder + "/summary.json")));
}

std::size_t linesOf(const std::filesystem::path &file)
{
  const std::string text = vpApp::readFile(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

//! Where what moves was first and last, in the base.
struct Way {
  explicit Way(const std::filesystem::path &folder)
  {
    bool isFirst = true;
    visualServo::readCycles(folder, [&](const visualServo::RecordedCycle &cycle) {
      first = isFirst ? cycle.fMc : first;
      isFirst = false;
      last = cycle.fMc;
    });
  }
  [[nodiscard]] double length() const { return (last.p - first.p).norm(); }
  vpRigidTransform first, last;
};

vpRigidTransform poseOf(const std::vector<double> &p) // m, degrees
{
  return {vpSO3::exp(vpMath::rad(1.) * Eigen::Vector3d(p[3], p[4], p[5])), {p[0], p[1], p[2]}};
}
} // namespace

TEST_CASE("the simulation reaches the goal; replay finds the same, and tells what another law would do", "[visp-servo]")
{
  ProgramRun run(SERVO);
  REQUIRE(run("--out a" + NEAR, WITH_REPORT) == OK);
  CHECK(run.out().find("The goal was reached.") == 0);
  const json summary = summaryIn(run, "a");
  CHECK(summary["end"]["status"] == "Converged");
  CHECK(summary["end"]["position_error_mm"].get<double>() < 1.);
  CHECK(summary["images_found"] == summary["images"]);
  CHECK(linesOf(run.path("a/log.csv")) == summary["cycles"].get<std::size_t>() + 1);
  CHECK(linesOf(run.path("a/images.csv")) == summary["images"].get<std::size_t>() + 1);
  for (const char *word : {"image_period", "latency", "vision", "step_period", "step_jitter", "step"}) {
    const json &time = summary["times"][word];
    CHECK(time["median_ms"].get<double>() >= 0.);
    std::size_t count = 0;
    for (const json &bin : time["histogram"]) {
      CHECK(bin[0] < bin[1]);
      count += bin[2].get<std::size_t>();
    }
    CHECK(count == time["count"]);
  }
  const std::string events = vpApp::readFile(run.path("a/events.csv"));
  CHECK(events.rfind("time_s,status,message\n0,NoImages,\"", 0) == 0);
  CHECK(events.find(",Converged,\"The goal is reached within the tolerances.\"\n") != std::string::npos);
  CHECK(summary["scene"]["camera"]["width"] == 640);
  CHECK(summary["scene"]["size_m"][0] == 0.12);
  CHECK(summary["scene"]["goal"][2][3].get<double>() == Approx(0.3).epsilon(0.1));
  CHECK(json::parse(vpApp::readFile(run.path("a/arm.json")))["name"] == "AMOR");
  CHECK(summary["times"]["latency"]["median_ms"].get<double>() ==
        Approx(45.).epsilon(0.06)); // 40 ms and a step of 5 ms
  for (const char *file : {"report.html", "view.mp4", "camera.mkv", "camera.xml", "target.png", "recording.json"}) {
    CHECK(std::filesystem::file_size(run.path(std::string("a/") + file)) > 100);
  }
  // The camera moved in the simulation as the log says it did.
  CHECK(Way(run.path("a")).length() > 0.003);

  REQUIRE(run("--replay a --out same") == OK);
  const json same = summaryIn(run, "same");
  CHECK(same["found_now"] == same["found_then"]);
  CHECK(same["velocity_largest_mps"].get<double>() < 1e-5);
  CHECK(same["angular_velocity_largest_radps"].get<double>() < 1e-5);
  REQUIRE(run("--replay a --out other --law pbvs1 --lambda 1") == OK);
  CHECK(summaryIn(run, "other")["velocity_largest_mps"].get<double>() > 1e-3);
  CHECK(run("--replay a --out a") == 2);
  CHECK(run.err().find("--out is a, the recording itself") != std::string::npos);

  // The recorded video as a camera, dry.
  REQUIRE(run("--camera a/camera.mkv --camera-xml a/camera.xml --dry-run --out film") == OK);
  CHECK(summaryIn(run, "film")["images_found"] == summary["images"]);
  CHECK(summaryIn(run, "film")["dry_run"] == true);
}

TEST_CASE("a taught goal is where the robot goes", "[visp-servo]")
{
  ProgramRun run(SERVO);
  REQUIRE(run("--teach goal.json --object-pose 0.01,0,0.32,0,3,0") == OK);
  CHECK(std::filesystem::file_size(run.path("goal.png")) > 10000);
  const json goal = json::parse(vpApp::readFile(run.path("goal.json")));
  CHECK(goal["position_m"][2].get<double>() == Approx(0.32).epsilon(1e-3));
  REQUIRE(run("--goal goal.json --out a --object-pose 0.012,0.002,0.323,0,4,1 --start-time 0.2 --lambda 3") == OK);
  CHECK(run.out().find("The goal was reached.") == 0);
}

namespace
{
//! The joint positions of AMOR in the log of a run.
std::vector<vpJointVector> jointsOf(const std::filesystem::path &folder)
{
  std::istringstream lines(vpApp::readFile(folder / "log.csv"));
  std::string line;
  std::getline(lines, line);
  const auto first = std::count(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(line.find("q_")), ',');
  std::vector<vpJointVector> all;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (std::ptrdiff_t i = 0; i < first; ++i) {
      std::getline(cells, cell, ',');
    }
    vpJointVector q = vpJointVector::Zero(7);
    for (int i = 0; i < 7; ++i) {
      std::getline(cells, cell, ',');
      q(i) = std::stod(cell);
    }
    all.push_back(q);
  }
  return all;
}
} // namespace

TEST_CASE("a reference image alone leads back to where it was taken", "[visp-servo]")
{
  ProgramRun run(SERVO);
  REQUIRE(run("--teach goal.json --object-pose 0,0,0.3,0,0,0") == OK);
  REQUIRE(run("--reference goal.png --out a --object-pose 0.02,0.01,0.34,2,-3,4 --start-time 0.2 --lambda 2") == OK);
  CHECK(run.out().find("The goal was reached.") == 0);
  // Where the camera should be is known here: the object was at (0.02, 0.01, 0.34), is to be at (0, 0, 0.3).
  const Way way(run.path("a"));
  const vpRigidTransform cMo = way.last.inverse() * way.first * poseOf({0.02, 0.01, 0.34, 2., -3., 4.});
  CHECK((cMo.p - Eigen::Vector3d(0., 0., 0.3)).cwiseAbs().maxCoeff() < 0.005);
  REQUIRE(run("--replay a --out same") == OK);
  CHECK(summaryIn(run, "same")["found_now"] == summaryIn(run, "same")["found_then"]);
  // The estimator of the distance magnifies the rounding of the logged poses.
  CHECK(summaryIn(run, "same")["velocity_largest_mps"].get<double>() < 1e-3);
}

TEST_CASE("a reference image alone is the mean of 25 images of a camera at rest", "[visp-servo][teach]")
{
  ProgramRun run(SERVO);
  REQUIRE(run("--teach mean.png --noise 3 --object-pose 0,0,0.3,0,0,0") == OK);
  CHECK(run.out().find("Reference image: mean of 25 images") == 0);
  const cv::Mat mean = cv::imread(run.path("mean.png").string(), cv::IMREAD_GRAYSCALE);
  vpImage<unsigned char> photo, clean;
  vpImageIo::read(photo, VISP_DIRECT_DATA_DIR "/target/klimt.jpg");
  const vpCameraParameters camera(600., 600., 319.5, 239.5);
  vpPlaneRenderer(photo, 0.12, 0.12 * photo.getHeight() / photo.getWidth(), camera, 640, 480)
      .render(vpHomogeneousMatrix(0., 0., 0.3, 0., 0., 0.), {}, 0, clean);
  const double noise = cv::norm(mean, cv::Mat(480, 640, CV_8UC1, clean.bitmap)) / std::sqrt(640. * 480.);
  CHECK(noise > 0.6); // 3 / sqrt(25), and the rounding of both
  CHECK(noise < 0.85);

  const cv::Mat image = mean(cv::Rect(160, 120, 320, 240));
  std::filesystem::create_directories(run.path("film"));
  for (int i = 0; i < 30; ++i) { // at rest for 20 images
    cv::Mat moved;
    const double shift = 2. * std::max(0, i - 20);
    cv::warpAffine(image, moved, cv::Matx23d(1., 0., shift, 0., 1., 0.), image.size());
    cv::imwrite(run.path("film/" + std::to_string(100 + i) + ".png").string(), moved);
  }
  CHECK(run("--camera film --teach moved.png") == DATA);
  INFO(run.err());
  CHECK(run.err().find("gave no 25 images in succession of a camera and a scene at rest. The camera or the scene has "
                       "moved by") != std::string::npos);
  CHECK(!std::filesystem::exists(run.path("moved.png")));
}

TEST_CASE("before a fixed camera the arm brings the target to the goal; replay finds the same, a dry run moves nothing",
          "[visp-servo][fixed]")
{
  ProgramRun run(SERVO);
  const std::string near = NEAR + " --camera-rate 10";
  REQUIRE(run("--eye-to-hand --out a" + near) == OK);
  CHECK(run.out().find("The goal was reached.") == 0);
  const Way way(run.path("a"));
  CHECK(way.length() > 0.003);
  // What the camera saw at first was the target's place on the end effector.
  const vpRigidTransform fMc = vpLoadPose(run.path("a/fMc.txt").string());
  const vpRigidTransform eMo = way.first.inverse() * fMc * poseOf({0.004, -0.003, 0.305, 1., -1., 1.});
  const vpRigidTransform cMo = fMc.inverse() * way.last * eMo;
  CHECK((cMo.p - Eigen::Vector3d(0., 0., 0.3)).norm() < 0.0015);
  CHECK(vpSO3::log(cMo.R).norm() < vpMath::rad(0.4));
  REQUIRE(run("--replay a --out same") == OK);
  CHECK(summaryIn(run, "same")["velocity_largest_mps"].get<double>() < 1e-5);
  CHECK(summaryIn(run, "same")["angular_velocity_largest_radps"].get<double>() < 1e-5);

  REQUIRE(run("--fMc a/fMc.txt --dry-run --duration 0.5 --out dry" + near) == OK);
  CHECK(Way(run.path("dry")).length() == 0.);
  CHECK((Way(run.path("dry")).first.p - way.first.p).norm() < 1e-8);
}

TEST_CASE("the arm stops before an obstacle of --scene, and the status names it", "[visp-servo][scene]")
{
  ProgramRun run(SERVO);
  const std::string task = " --object-pose 0.05,0.03,0.4,3,-5,4 --max-linear 0.5 --max-acceleration 2 --lambda 3 "
                           "--start-time 0.2 --camera-rate 10 ";
  CHECK(run(task + "--duration 1.2 --out free") == DATA); // on the way
  const vpArmModel arm = vpLoadArmJson(VISP_DIRECT_DATA_DIR "/robot/amor.json");
  const std::vector<vpJointVector> free = jointsOf(run.path("free"));
  vpCollisionData placed;
  vpCollisionScene(arm).place(free.back(), placed);
  const Eigen::Vector3d at = placed.capsules[3].to; // the hand
  vpCollisionObject ball;
  ball.name = "ball";
  ball.shape = vpCollisionShape::sphere(0.03);
  ball.pose.p = at;
  vpCollisionSceneSpec spec;
  spec.objects.push_back(ball);
  const vpCollisionScene scene(arm, spec);
  const auto least = [&](const std::vector<vpJointVector> &way) {
    double distance = 1.;
    for (const vpJointVector &q : way) {
      scene.place(q, placed);
      distance = std::min(distance, scene.clearance(placed).distance);
    }
    return distance;
  };
  REQUIRE(least({free.front()}) > 0.03);
  REQUIRE(least(free) < 0.);
  run.write("ball.json", json{{"name", "one ball"},
                              {"objects",
                               {{{"name", "ball"},
                                 {"shape", "sphere"},
                                 {"radius_m", 0.03},
                                 {"pose", {{"translation_m", {at.x(), at.y(), at.z()}}}}}}}}
                             .dump());
  CHECK(run(task + "--scene ball.json --margin 0.015 --duration 2 --out a") == DATA);
  INFO(run.err());
  CHECK(run.err().find("in the way: link 7 and object ball") != std::string::npos);
  CHECK(run.out().find("In the way: link 7 and object ball.") != std::string::npos);
  CHECK(summaryIn(run, "a")["end"]["status"] == "Obstructed");
  CHECK(vpApp::readFile(run.path("a/log.csv")).find(",\"link 7 and object ball\"\n") != std::string::npos);
  const std::vector<vpJointVector> stopped = jointsOf(run.path("a"));
  CHECK(least(stopped) > 0.0075); // the margin less what the drives lag behind their commands
  CHECK(least(stopped) < 0.03);
}

TEST_CASE("a robot of a plug-in moves after --start, by the clock", "[visp-servo][plugin]")
{
  ProgramRun run(SERVO);
  const std::string robot =
      "--camera sim --robot-plugin '" ROBOT_ARM "' --robot-arguments '" VISP_DIRECT_DATA_DIR "/robot/amor.json'" + NEAR;
  run.write("eMc.txt", "0 -0.06 -0.12 0 0 0"); // as in the model: twists of the end effector
  REQUIRE(run(robot + " --eMc eMc.txt --start --out a") == OK);
  CHECK(run.out().find("The goal was reached.") == 0);
  CHECK(summaryIn(run, "a")["times"]["step_period"]["median_ms"].get<double>() == Approx(5.).epsilon(0.2));
  REQUIRE(run(robot + " --eye-to-hand --start --out c") == OK);
  CHECK(run.out().find("The goal was reached.") == 0);
  REQUIRE(run(robot + " --duration 0.3 --out b") == OK);
  CHECK(run.out().find("The robot was not told to move") != std::string::npos);
  CHECK(summaryIn(run, "b")["end"]["status"] == "Idle");
}

namespace
{
//! Starts the program in the folder of \e run.
pid_t start(const ProgramRun &run, const std::vector<std::string> &arguments)
{
  const pid_t child = fork();
  if (child == 0) {
    std::vector<char *> argv;
    std::string program = SERVO;
    argv.push_back(program.data());
    std::vector<std::string> copies = arguments;
    for (std::string &argument : copies) {
      argv.push_back(argument.data());
    }
    argv.push_back(nullptr);
    if (chdir(run.path("").c_str()) != 0 || std::freopen("/dev/null", "w", stdout) == nullptr ||
        std::freopen("/dev/null", "w", stderr) == nullptr) {
      _exit(99);
    }
    unsetenv("VISP_DIRECT_PYTHON"); // with a report
    execv(SERVO, argv.data());
    _exit(98);
  }
  return child;
}

//! Waits until a file has at least this number of lines.
bool waitForLines(const std::filesystem::path &file, std::size_t lines)
{
  for (int i = 0; i < 600; ++i) {
    if (std::filesystem::exists(file) && linesOf(file) >= lines) {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}
} // namespace

TEST_CASE("Ctrl-C ends with a report; a killed program leaves what it recorded, and that can be replayed",
          "[visp-servo]")
{
  ProgramRun run(SERVO);
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    CAPTURE(signal);
    const std::string out = "s" + std::to_string(signal);
    const pid_t child = start(run, {"--real-time", "--stay", "--duration", "60", "--out", out});
    REQUIRE(waitForLines(run.path(out + "/unfinished-run/log.csv"), signal == SIGKILL ? 800 : 200));
    REQUIRE(kill(child, signal) == 0);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    if (signal != SIGKILL) {
      CHECK(WIFEXITED(status));
      CHECK(WEXITSTATUS(status) == 130);
      CHECK(summaryIn(run, out)["status"] == "interrupted");
      CHECK(std::filesystem::file_size(run.path(out + "/report.html")) > 10000);
      CHECK(linesOf(run.path(out + "/log.csv")) > 200);
    }
    else {
      CHECK(WIFSIGNALED(status));
      REQUIRE(run("--replay " + out + "/unfinished-run --out again") == OK);
      CHECK(summaryIn(run, "again")["cycles"].get<int>() >= 700);
      const json again = summaryIn(run, "again"); // the video lacks what was not yet flushed
      CHECK(again["images"].get<int>() > 0);
      CHECK(again["found_now"] == again["images"]);
      CHECK(again["found_then"] == again["images"]);
    }
  }
}

TEST_CASE("the goal that is not reached in time is status 1, with the report", "[visp-servo]")
{
  ProgramRun run(SERVO);
  CHECK(run("--duration 0.5 --out a", WITH_REPORT) == DATA);
  CHECK(run.err().find("the goal was not reached in 0.5 s; the report shows the way (at the end: The ") !=
        std::string::npos);
  CHECK(std::filesystem::exists(run.path("a/report.html")));
}

TEST_CASE("a goal out of reach is reported before the arm moves, and at the end", "[visp-servo]")
{
  const std::string word = "no joint positions were found that reach the goal";
  ProgramRun run(SERVO);
  CHECK(run("--duration 0.5 --out a") == DATA);
  CHECK(run.err().find(word) == std::string::npos);
  CHECK(run("--duration 0.5 --object-pose 0,0,4,0,0,0 --size 2 --goal-pose 0,0,1,0,0,0 --out b") == DATA);
  CHECK(run.err().find("visp-servo: " + word + ", 3.000 m and 0.0 degrees away") != std::string::npos);
  CHECK(run.out().find("At the end: " + word) != std::string::npos);
}

TEST_CASE("a rendered camera has the intrinsics of a file", "[visp-servo]")
{
  ProgramRun run(SERVO);
  run.write("mine.xml",
            "<root><camera><name>Mine</name><image_width>400</image_width><image_height>300</image_height><model>"
            "<type>perspectiveProjWithDistortion</type><px>410</px><py>412</py><u0>203</u0><v0>148</v0><kud>-0.1</kud>"
            "<kdu>0.1</kdu></model></camera></root>");
  CHECK(run("--camera-xml mine.xml --out a") == OK);
  const json camera = summaryIn(run, "a")["scene"]["camera"];
  CHECK(camera == json{{"px", 410.}, {"py", 412.}, {"u0", 203.}, {"v0", 148.}, {"width", 400}, {"height", 300}});
}

TEST_CASE("an AprilTag of ViSP's images is found", "[visp-servo]")
{
  const std::string image = vpIoTools::getViSPImagesDataPath() + "/AprilTag/benchmark/640x480/tag36_11_640x480.png";
  if (!std::filesystem::exists(image)) {
    vpTestSupport::skip("visp-images-data is not installed");
    return;
  }
  ProgramRun run(SERVO);
  REQUIRE(run("--camera '" + image + "' --tag 36h11:0 --size 0.25 --out a") == OK);
  CHECK(summaryIn(run, "a")["images_found"] == 1);
  REQUIRE(run("--camera '" + image + "' --tag 36h11:500 --size 0.25 --out b") == OK);
  CHECK(summaryIn(run, "b")["images_found"] == 0);
}

TEST_CASE("laws and robots are listed", "[visp-servo]")
{
  ProgramRun run(SERVO);
  REQUIRE(run("--list") == OK);
  for (const char *word : {"ff-lookat-pi: ", "vpRobotFranka", "vpRobotUniversalRobots", "vpRobotViper850"}) {
    CHECK(run.out().find(word) != std::string::npos);
  }
}
