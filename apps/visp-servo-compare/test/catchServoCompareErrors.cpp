/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Every kind of bad input: exit status, one message naming the item and its value, and nothing written.
#include "vpCatch.h"

#include "programRun.h"

#include <algorithm>

namespace
{
constexpr int DATA = 1;
constexpr int USAGE = 2;

//! The valid task file, with one part replaced.
std::string task(const std::string &piece = "", const std::string &replacement = "")
{
  std::string text = R"({
  "camera": {"px": 800, "py": 800, "u0": 320, "v0": 240},
  "object": {"width_m": 0.18, "height_m": 0.18},
  "start": {"position_m": [0, 0, 0.5], "rotation_deg": [0, 0, 0]},
  "segments": [{"position_m": [0, 0, 0.4], "rotation_deg": [0, 0, 0], "duration_s": 1}],
  "gains": {"lambda": 1},
  "shape": {"linear_jerk_mps3": 20},
  "plants": [{"name": "P", "vision_rate_hz": 10}]
})";
  if (!piece.empty()) {
    text.replace(text.find(piece), piece.size(), replacement);
  }
  return text;
}

std::string grey(int width, int height) // a PGM file
{
  return "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n" +
         std::string(width * height, '\x7f');
}

struct Case {
  std::string arguments;
  int status;
  std::string sentence; //!< What stderr must contain.
};

void check(ProgramRun &run, const Case &bad)
{
  std::vector<std::string> before = run.entries();
  const int status = run(bad.arguments + " --out result");
  CAPTURE(bad.arguments, run.err(), run.out());
  CHECK(status == bad.status);
  CHECK(run.err().find("visp-servo-compare: ") == 0);
  CHECK(run.err().find(bad.sentence) != std::string::npos);
  CHECK(std::count(run.err().begin(), run.err().end(), '\n') == 1);
  CHECK(run.out().empty());
  std::vector<std::string> after = run.entries();
  std::sort(before.begin(), before.end());
  std::sort(after.begin(), after.end());
  CHECK(before == after);
}
} // namespace

TEST_CASE("A wrong command line ends with status 2", "[visp-servo-compare]")
{
  ProgramRun run(SERVO_COMPARE);
  const std::vector<Case> cases = {
      {"--nonsense", USAGE, "--nonsense"},
      {"surplus", USAGE, "surplus"},
      {"--law pbvs9", USAGE, "unknown law \"pbvs9\"; known are pbvs1, "},
      {"--law pbvs1+cbf+cbf", USAGE, "unknown law \"pbvs1+cbf+cbf\""},
      {"--law pbvs1,ff-dtg+cbf", USAGE, "\"ff-dtg+cbf\": the view filter (+cbf) cannot follow a law that plans"},
      {"--plant Z", USAGE, "unknown plant \"Z\"; known are A, B and D"},
      {"--measure radar", USAGE, "unknown measure \"radar\"; known are points and image"},
      {"--jobs 0", USAGE, "--jobs is 0, must be"},
      {"--jobs two", USAGE, "--jobs is two, must be"},
      {"--monte-carlo -3", USAGE, "--monte-carlo is -3, must be"},
      {"--monte-carlo 0", USAGE, "--monte-carlo is 0, must be"},
      {"--seed minus", USAGE, "--seed"},
      {"--full --law pbvs1", USAGE, "--full"},
      {"--target none.jpg", DATA, "none.jpg: cannot be read (there is no such file)"},
      {"--task none.json", DATA, "none.json: cannot be read (there is no such file)"},
      {"--law", USAGE, "--law"},
      {"--shape=soft", USAGE, "--shape"},
  };
  for (const Case &bad : cases) {
    check(run, bad);
  }
}

TEST_CASE("A bad robot ends with a sentence that names the file and the element", "[visp-servo-compare]")
{
  ProgramRun run(SERVO_COMPARE);
  check(run, {"--robot spot", USAGE, "--robot is spot, must be camera, amor, a .urdf or a .json file"});
  check(run, {"--robot amor --self-motion dance", USAGE, "--self-motion: unknown wish \"dance\""});
  check(run, {"--robot amor --drive sliding", USAGE, "--drive"});
  check(run, {"--robot amor --free yaw", USAGE, "--free: free axis \"yaw\" is unknown, must be x, y, z, rx, ry or rz"});
  check(run, {"--free rz", USAGE, "--free needs an arm, given by --robot"});
  check(run, {"--robot amor --self-motion none,limits", USAGE, "--self-motion: unknown wish \"none\""});
  check(run, {"--limits bounce", USAGE, "--limits is bounce, must be stop or scale"});
  check(run, {"--acceleration-limits -1", USAGE, "--acceleration-limits is -1, must be a number > 0"});
  check(run, {"--robot none.urdf", DATA, "none.urdf"});
  run.write("broken.urdf", "<robot name='b'><link");
  check(run, {"--robot broken.urdf", DATA, "broken.urdf"});
  const std::string links = "<robot name='b'><link name='a'/><link name='b'/><link name='c'/>";
  const std::string joint = "<joint name='j' type='revolute'><parent link='a'/><child link='b'/>"
                            "<limit lower='-1' upper='1' velocity='1' effort='1'/></joint>";
  run.write("two.urdf", links + joint +
                            "<joint name='k' type='revolute'><parent link='a'/><child link='c'/><limit lower='-1' "
                            "upper='1' velocity='1' effort='1'/></joint></robot>");
  check(run, {"--robot two.urdf --plant A", DATA, "two.urdf"});
  check(run, {"--robot two.urdf --robot-tip z --plant A", DATA, "two.urdf"});
  // One joint cannot move the camera to all poses; an arm without masses cannot be torque-driven.
  check(run, {"--robot two.urdf --robot-tip b --plant A", DATA, "from none of 200 start configurations"});
  std::string amor = vpApp::readFile(std::string(VISP_DIRECT_DATA_DIR) + "/robot/amor.json");
  const std::string mass =
      "\"mass_kg\": 2.4, \"com_m\": [0.0, 0.0, 0.0], \"inertia_kg_m2\": [0.012, 0.012, 0.012, 0, 0, 0]";
  REQUIRE(amor.find(", " + mass) != std::string::npos);
  amor.erase(amor.find(", " + mass), mass.size() + 2);
  run.write("light.json", amor);
  check(run, {"--robot light.json --plant A,B", DATA, "link2"});
  const std::string limit = "\"acceleration\": 6.0, ";
  amor.erase(amor.find(limit), limit.size());
  run.write("unlimited.json", amor);
  check(run, {"--robot unlimited.json --plant A", DATA,
              "unlimited.json: joint q1 has no acceleration limit, --acceleration-limits"});
}

TEST_CASE("A bad photo ends with status 1", "[visp-servo-compare]")
{
  ProgramRun run(SERVO_COMPARE);
  run.write("text.jpg", "this is not an image");
  run.write("empty.png", "");
  run.write("dot.pgm", grey(1, 1));
  run.write("blank.pgm", grey(200, 150));
  std::filesystem::create_directory(run.path("folder.png"));
  check(run, {"--target text.jpg", DATA, "text.jpg: is not an image"});
  check(run, {"--target empty.png", DATA, "empty.png: is not an image"});
  check(run, {"--target dot.pgm", DATA, "dot.pgm: is 1x1 px, must be at least 32x32 px"});
  check(run, {"--target blank.pgm", DATA, "blank.pgm: "});
  check(run, {"--target folder.png", DATA, "folder.png: cannot be read (it is a folder)"});
}

TEST_CASE("A bad task file ends with status 1 and names the field", "[visp-servo-compare]")
{
  ProgramRun run(SERVO_COMPARE);
  const auto with = [&](const std::string &content, const std::string &sentence) {
    run.write("task.json", content);
    check(run, {"--task task.json", DATA, "task.json: " + sentence});
  };
  with("", "line 1, column 1: ");
  with("{\n  \"camera\": [\n}", "line 3, column 1: ");
  with(task("\"lambda\": 1", "\"lambda\": NaN"), "line 6, column ");
  with(task("\"lambda\": 1", "\"lambda\": 1e999"), "line 6, column 27: number overflow parsing '1e999'");
  with(task("\"lambda\": 1", "\"lambda\": \"NaN\""), "gains.lambda is \"NaN\", must be a number");
  with(task("\"lambda\": 1", "\"lambda\": -1"), "gains.lambda is -1, must be > 0, <= 1000000 1/s");
  with(task("\"lambda\": 1", "\"lamda\": 1"), "unknown field gains.lamda; known are ");
  with(task("\"vision_rate_hz\": 10", "\"vision_rate_hz\": -10"), "plants[0].vision_rate_hz is -10, must be > 0 Hz");
  with(task("\"vision_rate_hz\": 10", "\"vision_rate_hz\": 1000"), "plants[0]: visionRate of the plant is 1000 Hz");
  with(task("\"vision_rate_hz\": 10", "\"like\": \"Q\""), "plants[0]: unknown plant 'Q'");
  with(task("[{\"name\": \"P\"", "[{\"name\": \"P\"}, {\"name\": \"P\""), "plants[1]: there is a plant \"P\" before");
  with(task("\"duration_s\": 1", "\"duration_s\": 0"), "duration of segment 0");
  with(task("[0, 0, 0.4]", "[0, 0, -0.4]"), "cdMo of segment 0");
  with(task("[0, 0, 0.4]", "[0, 0]"), "segments[0].position_m is [0,0], must be a list of 3 numbers");
  with(task("\"px\": 800", "\"px\": 0"), "camera: px is 0, must be > 0");
  with(task("\"width_m\": 0.18", "\"width_m\": -0.18"), "objectWidth of the task is -0.18");
  with(task("\"object\"", "\"objekt\""), "object is missing");
  // The shaper's limits are checked with and without --shape.
  const std::string jerk = "\"linear_jerk_mps3\": 20";
  with(task(jerk, "\"linear_jerk_mps3\": 0"), "shape.linear_jerk_mps3 is 0, must be 1e-06..1e+12 or infinite m/s^3");
  with(task(jerk, "\"linear_acceleration_mps2\": -1"), "shape.linear_acceleration_mps2 is -1, must be 1e-06..1e+09");
  with(task(jerk, "\"angular_acceleration_radps2\": -0.5"), "shape.angular_acceleration_radps2 is -0.5, must be");
  with(task(jerk, "\"angular_jerk_radps3\": -25"), "shape.angular_jerk_radps3 is -25, must be");
  with(task(jerk, "\"angular_jerk_radps3\": \"inf\""), "shape.angular_jerk_radps3 is \"inf\", must be a number");
  with(task(jerk, "\"linear_jerk\": 20"), "unknown field shape.linear_jerk; known are ");
  with(task("{" + jerk + "}", "[1, 10]"), "shape is [1,10], must be ");
  run.write("task.json", task());
  check(run, {"--task task.json --plant Q", USAGE, "unknown plant \"Q\"; known are A, B, D and P"});
}

TEST_CASE("A result folder that cannot be written ends with status 1 before anything is run", "[visp-servo-compare]")
{
  ProgramRun run(SERVO_COMPARE);
  run.write("file", "");
  CHECK(run("--out file/result") == DATA);
  CHECK(run.err().find("file/result: cannot be written") != std::string::npos);
  CHECK(run("--out file") == DATA);
  CHECK(run.err().find("file: exists and is not a folder") != std::string::npos);
  std::filesystem::create_directory(run.path("mine"));
  run.write("mine/thesis.tex", "years of work");
  CHECK(run("--out mine") == DATA);
  CHECK(run.err().find("mine: is not empty and not a result of visp-servo-compare") != std::string::npos);
  CHECK(std::filesystem::exists(run.path("mine/thesis.tex")));
  CHECK(run("--out ''") == USAGE);
}

TEST_CASE("What the machine lacks is named", "[visp-servo-compare]")
{
  ProgramRun run(SERVO_COMPARE);
  CHECK(run("--display --out result", "env -u DISPLAY") == DATA);
  CHECK(run.err().find("--display needs a screen") != std::string::npos);
  CHECK(run("--out result", "VISP_DIRECT_DATA=/nowhere") == DATA);
  CHECK(run.err().find("data file target/klimt.jpg is not in /nowhere") != std::string::npos);
  CHECK(run.entries().empty());
}
