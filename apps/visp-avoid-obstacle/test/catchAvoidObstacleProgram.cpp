/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The program itself: good and bad input, and runs from image to joints.
#include "vpCatch.h"

#include "jsonReader.h"
#include "programRun.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace
{
constexpr int DATA = 1;
constexpr int USAGE = 2;
constexpr int HIT = 3;

//! Reports are tested with Python; where this file asks for one it sets the variable back.
[[maybe_unused]] const int withoutReports = setenv("VISP_DIRECT_PYTHON", "none", 1);

//! The default scene, with one part replaced.
std::string scene(const std::string &piece = "", const std::string &replacement = "")
{
  std::string text = vpApp::readFile(std::string(VISP_DIRECT_DATA_DIR) + "/scene/photo-box.json");
  if (!piece.empty()) {
    REQUIRE(text.find(piece) != std::string::npos);
    text.replace(text.find(piece), piece.size(), replacement);
  }
  return text;
}

void check(ProgramRun &run, const std::string &arguments, int status, const std::string &sentence)
{
  std::vector<std::string> before = run.entries();
  const int answer = run(arguments + " --out result");
  CAPTURE(arguments, run.err(), run.out());
  CHECK(answer == status);
  CHECK(run.err().find("visp-avoid-obstacle: ") == 0);
  CHECK(run.err().find(sentence) != std::string::npos);
  CHECK(std::count(run.err().begin(), run.err().end(), '\n') == 1);
  CHECK(run.out().empty());
  std::vector<std::string> after = run.entries();
  std::sort(before.begin(), before.end());
  std::sort(after.begin(), after.end());
  CHECK(before == after);
}

nlohmann::json summaryOf(ProgramRun &run, const std::string &arguments, int expected = 0)
{
  const int status = run(arguments + " --out result");
  CAPTURE(arguments, run.err());
  REQUIRE(status == expected);
  return vpApp::readJsonFile(run.path("result/summary.json").string());
}

//! Options for a database with only the box, to avoid searching for other targets.
std::string onlyBox(const ProgramRun &run)
{
  const std::filesystem::path from = std::filesystem::path(VISP_DIRECT_DATA_DIR) / "target/box.png";
  std::filesystem::create_directory(run.path("targets"));
  std::filesystem::copy_file(from, run.path("targets/box.png"), std::filesystem::copy_options::overwrite_existing);
  run.write("targets/targets.json",
            R"({"targets": [{"name": "box", "image": "box.png", "width_m": 0.16, "depth_m": 0.06}]})");
  return " --targets targets ";
}

std::size_t linesOf(const std::string &text)
{
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}
} // namespace

TEST_CASE("A wrong command line ends with status 2", "[visp-avoid-obstacle]")
{
  ProgramRun run(AVOID_OBSTACLE);
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"--nonsense", "--nonsense"},
      {"--method luck", "--method: unknown \"luck\"; known are "},
      {"--replica fig8.5", "--replica: unknown \"fig8.5\"; known are fig8.6, "},
      {"--replica fig8.7 --method dtg", "--method cannot be combined with --replica"},
      {"--replica fig8.7 --record", "--record cannot be combined with --replica"},
      {"--sensor nose", "--sensor is nose, must be image, depth or poses"},
      {"--hide 1", "--hide is 1, must be FROM:UNTIL in s"},
      {"--hide 2:1", "--hide is 2:1, must end after it begins"},
      {"--hide x:1", "--hide is x, must be a number"},
      {"--vision-rate 0", "--vision-rate is 0, must be a number > 0"},
      {"--vision-rate nan", "--vision-rate is nan, must be a number"},
      {"--latency -1", "--latency is -1, must be a number >= 0"},
      {"--duration 0", "--duration is 0, must be a number > 0"},
      {"--noise 101", "--noise is 101, must be a number >= 0 and <= 100"},
      {"--friction many", "--friction is many, must be a number"},
      {"--forget -2", "--forget is -2, must be a number"},
      {"--seed 0", "--seed is 0, must be a whole number from 1 to 1000000"},
      {"--seed 1.5", "--seed is 1.5, must be a whole number"},
      {"--scene ''", "--scene is given without a value"}};
  for (const auto &[arguments, sentence] : cases) {
    check(run, arguments, USAGE, sentence);
  }
}

TEST_CASE("A bad scene ends with a sentence that names file and element", "[visp-avoid-obstacle]")
{
  ProgramRun run(AVOID_OBSTACLE);
  const auto bad = [&](const std::string &piece, const std::string &replacement, const std::string &sentence) {
    run.write("bad.json", scene(piece, replacement));
    check(run, "--scene bad.json", DATA, "bad.json: " + sentence);
  };
  bad("\"photo\": \"box\"", "\"photo\": \"mona-lisa\"", "photo of object parcel is mona-lisa, must be a target of ");
  bad(", \"photo\": \"box\"", "", "no object has a photo, --sensor image sees nothing; depth and poses need none");
  bad("[0.16, 0.11012, 0.06]", "[0.2, 0.11012, 0.06]",
      "size_m of object parcel is 0.2 x 0.1101, its photo box is 0.16");
  bad("\"shape\": \"box\", \"size_m\": [0.16, 0.11012, 0.06]", "\"shape\": \"sphere\", \"radius_m\": 0.1",
      "objects[0].photo is \"box\", must be on a box");
  bad("\"tasks\": [", "\"errands\": [", "unknown field errands; known are ");
  bad("0.127099, ", "", "tasks[0].goal_rad is [");
  bad("\"objects\": [",
      "\"objects\": [{\"name\": \"fly\", \"shape\": \"sphere\", \"radius_m\": 0.01, \"velocity\": {\"linear_m_s\": [1, "
      "0, 0]}},",
      "object fly moves but has no photo");
  run.write("bad.json", R"({"name": "s", "objects": []})");
  check(run, "--scene bad.json", DATA, "bad.json: tasks is empty, there is nowhere to go");
  run.write("bad.json", R"({"name": "s", "objects": [], "tasks": [{"name": "t", "start_rad": [0], "goal_rad": [1]}]})");
  check(run, "--scene bad.json", DATA, "task t is for 1 joints, arm ");
  run.write("bad.json", "{");
  check(run, "--scene bad.json", DATA, "bad.json: line 1, column 2: syntax error");
}

TEST_CASE("From image to joints: round what is seen, into what is not", "[visp-avoid-obstacle]")
{
  ProgramRun run(AVOID_OBSTACLE);
  // The same scene twice. With the camera always covered the box is unknown, and the tool hits it: so the images make
  // the difference.
  const nlohmann::json blind = summaryOf(run, "--hide 0:100" + onlyBox(run), HIT);
  CHECK_FALSE(blind.at("metrics").at("success").get<bool>());
  CHECK(blind.at("metrics").at("collisions_moving").get<int>() > 0);
  CHECK(blind.at("metrics").at("min_clearance_m").get<double>() < 0.);
  CHECK(blind.at("obstacles")[0].at("seen").get<int>() == 0);
  CHECK(blind.at("obstacles")[0].at("first_seen_s").is_null());
  CHECK(run.out().find("never seen") != std::string::npos);

  const nlohmann::json seeing = summaryOf(run, "--hide 0.2:0.4 --record --latency 0.06");
  const nlohmann::json &metrics = seeing.at("metrics"), &box = seeing.at("obstacles")[0];
  CHECK(metrics.at("success").get<bool>());
  CHECK(metrics.at("min_clearance_m").get<double>() > 0.01);
  CHECK(metrics.at("tool_v_violations").get<int>() == 0);
  CHECK(metrics.at("tool_a_violations").get<int>() == 0);
  CHECK(metrics.at("joint_v_violations").get<int>() == 0);
  CHECK(metrics.at("joint_a_violations").get<int>() == 0);
  CHECK(box.at("first_seen_s").get<double>() == 0.);
  CHECK(box.at("known_s").get<double>() == Approx(0.06).margin(1e-9)); // by then the first image is processed
  CHECK(box.at("longest_gap_s").get<double>() >= 0.2);
  CHECK(box.at("worst_error_m").get<double>() < 0.01);
  CHECK(box.at("least_inflation_less_error_m").get<double>() >= 0.);

  const std::string samples = vpApp::readFile(run.path("result/samples.csv"));
  const std::string frames = vpApp::readFile(run.path("result/frames.csv"));
  CHECK(samples.find("time_s,q_q1,") == 0);
  CHECK(linesOf(frames) == box.at("pictures").get<std::size_t>() + 1);
  CHECK(linesOf(samples) > 6 * linesOf(frames)); // 200 Hz and 30 Hz
  std::istringstream rows(frames);
  std::string row;
  std::getline(rows, row);
  int covered = 0;
  while (std::getline(rows, row)) {
    const double time = std::stod(row);
    const bool dark = time >= 0.2 - 1e-9 && time < 0.4 - 1e-9;
    CHECK((row.find(",1,\"parcel\",0") != std::string::npos) == dark); // covered, so not seen
    covered += dark ? 1 : 0;
  }
  CHECK(covered == 6);
  for (const char *file : {"tracks.csv", "arm.json", "scene.json", "view/0.jpg", "video.mp4"}) {
    CAPTURE(file);
    CHECK(std::filesystem::file_size(run.path(std::string("result/") + file)) > 1000);
  }
  CHECK(run.out().find("The tool arrived after") == 0);
  CHECK(seeing.at("findings")[0].get<std::string>().find("The tool arrived after") == 0);
}

TEST_CASE("The same run twice is the same, another seed is another noise", "[visp-avoid-obstacle]")
{
  ProgramRun run(AVOID_OBSTACLE);
  const auto framesOf = [&](const std::string &arguments) {
    static_cast<void>(summaryOf(run, arguments + onlyBox(run) + " --duration 0.4"));
    return vpApp::readFile(run.path("result/frames.csv"));
  };
  const std::string first = framesOf("--seed 3");
  CHECK(first == framesOf("--seed 3"));
  CHECK(first != framesOf("--seed 4"));
}

TEST_CASE("An arm that waits has done its work, too", "[visp-avoid-obstacle]")
{
  ProgramRun run(AVOID_OBSTACLE);
  const nlohmann::json summary = summaryOf(run, "--method potential-corrected --duration 3" + onlyBox(run));
  CHECK_FALSE(summary.at("metrics").at("success").get<bool>());
  CHECK(summary.at("metrics").at("collisions_moving").get<int>() == 0);
  CHECK(run.out().find("The tool did not arrive") == 0);
  CHECK_THAT(run.out(), Catch::Contains("touched nothing. The run ended as its longest duration of 3 s was over. "));
}

TEST_CASE("Depth images and poses lead round the box, too", "[visp-avoid-obstacle]")
{
  ProgramRun run(AVOID_OBSTACLE);
  for (const char *sensor : {"depth", "poses"}) {
    const nlohmann::json summary = summaryOf(run, std::string("--sensor ") + sensor);
    CAPTURE(sensor);
    CHECK(summary.at("metrics").at("success").get<bool>());
    CHECK(summary.at("metrics").at("min_clearance_m").get<double>() > 0.);
  }
}

TEST_CASE("Depth images and poses need no photograph", "[visp-avoid-obstacle]")
{
  ProgramRun run(AVOID_OBSTACLE);
  run.write("my-scene.json", scene(", \"photo\": \"box\"", ""));
  for (const char *sensor : {"depth", "poses"}) {
    CAPTURE(sensor);
    const nlohmann::json seeing = summaryOf(run, std::string("--scene my-scene.json --sensor ") + sensor);
    CHECK(seeing.at("metrics").at("success").get<bool>());
    CHECK(seeing.at("metrics").at("min_clearance_m").get<double>() > 0.);
    // Vision makes the difference: in the dark it hits the box, and the status reports it.
    const nlohmann::json blind =
        summaryOf(run, std::string("--scene my-scene.json --hide 0:100 --sensor ") + sensor, HIT);
    CHECK(blind.at("metrics").at("collisions_moving").get<int>() > 0);
  }
  // A ball, which carries no photograph, and moves.
  run.write("ball.json", scene("\"shape\": \"box\", \"size_m\": [0.16, 0.11012, 0.06], \"photo\": \"box\"",
                               "\"shape\": \"sphere\", \"radius_m\": 0.06, \"velocity\": {\"linear_m_s\": [0, 0, "
                               "0.01]}"));
  CHECK(summaryOf(run, "--scene ball.json --sensor poses").at("metrics").at("success").get<bool>());
  run.write("none.json", R"({"name": "s", "objects": [], "tasks": [{"name": "t", "start_rad": [0, 0, 0, 0, 0, 0, 0],
                            "goal_rad": [1, 0, 0, 0, 0, 0, 0]}]})");
  check(run, "--scene none.json --sensor depth", DATA, "none.json: objects is empty, there is nothing to see");
}

TEST_CASE("A replica leaves its data", "[visp-avoid-obstacle]")
{
  ProgramRun run(AVOID_OBSTACLE);
  const nlohmann::json summary = summaryOf(run, "--replica fig8.12");
  CHECK(summary.at("replica") == "fig8.12");
  CHECK(linesOf(vpApp::readFile(run.path("result/samples.csv"))) > 100);
  REQUIRE(run("--list") == 0);
  std::istringstream list(run.out());
  std::string line;
  int named = 0;
  while (std::getline(list, line)) { // a name and a sentence each, except the two headings
    CAPTURE(line);
    CHECK((line.find("  ") != 0 || line.size() > line.find(": ") + 20));
    named += line.find("  ") == 0 ? 1 : 0;
  }
  CHECK(named == 6 + 8);
  for (const char *name : {"  dtg-via: ", "  planner-dtg: ", "  fig8.6: ", "  fig8.13: "}) {
    CHECK(run.out().find(name) != std::string::npos);
  }
}
