/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A law from a plug-in beside ours: it does what pbvs1 does, so both must leave the same runs.
#include "vpCatch.h"

#include "jsonReader.h"
#include "programRun.h"

#include <algorithm>
#include <filesystem>

namespace
{
const bool s_quick = withoutReports();
const std::string PLUGIN_OPTION = std::string("--plugin '") + PLUGIN + "' ";
} // namespace

TEST_CASE("A law of a plug-in runs beside ours, with filter and recovery", "[visp-servo-compare][plugin]")
{
  ProgramRun run(SERVO_COMPARE);
  run.write("task.json", R"({
  "camera": {"px": 800, "py": 800, "u0": 320, "v0": 240},
  "object": {"width_m": 0.18, "height_m": 0.18},
  "start": {"position_m": [0, 0, 0.5], "rotation_deg": [0, 0, 0]},
  "segments": [{"position_m": [0.25, 0, 0.5], "rotation_deg": [0, 20, 0], "duration_s": 6}],
  "gains": {"rotation": 4},
  "plants": [{"name": "D", "vision_rate_hz": 10, "pixel_noise_px": 0.3, "latency_s": 0.1}]
})"); // turns ahead of the translation, and so out of the view
  const int status = run(PLUGIN_OPTION + "--law again,pbvs1,again+cbf,pbvs1+cbf --task task.json --measure points "
                                         "--shape --out result");
  CAPTURE(run.err());
  REQUIRE(status == 0);
  const nlohmann::json summary = vpApp::readJsonFile(run.path("result/summary.json"));
  REQUIRE(summary["runs"].size() == 8);
  for (const std::string end : {"", "+cbf"}) {
    for (const std::string shape : {"", "-shaped"}) {
      const auto log = [&](const std::string &law) {
        return vpApp::readFile(run.path("result/log/" + law + end + "-D-points-seed1" + shape + ".csv"));
      };
      CAPTURE(end, shape);
      CHECK(log("again") == log("pbvs1"));
      CHECK(log("again").size() > 100000);
    }
  }
  const auto has = [&](const std::string &name, const std::string &word) {
    return vpApp::readFile(run.path("result/log/" + name + "-D-points-seed1.csv")).find(word) != std::string::npos;
  };
  CHECK(has("again", "Retreating"));
  CHECK(has("again+cbf", "ViewLimited"));
  CHECK(summary["laws"][0]["sentence"] == "Does what pbvs1 does, from a plug-in.");
}

TEST_CASE("The list has the laws of a plug-in", "[visp-servo-compare][plugin]")
{
  ProgramRun run(SERVO_COMPARE);
  REQUIRE(run(PLUGIN_OPTION + "--list") == 0);
  CHECK(run.out().find("  again            Does what pbvs1 does, from a plug-in.\n") != std::string::npos);
  REQUIRE(run("--list") == 0);
  CHECK(run.out().find("  again ") == std::string::npos);
}

TEST_CASE("What is wrong with a plug-in is one sentence", "[visp-servo-compare][plugin][errors]")
{
  ProgramRun run(SERVO_COMPARE);
  run.write("text.so", "no library");
  const auto check = [&run](const std::string &arguments, int status, const std::string &sentence) {
    const int ended = run(arguments + " --out result");
    CAPTURE(arguments, run.err());
    CHECK(ended == status);
    CHECK(run.err().find(sentence) != std::string::npos);
    CHECK(std::count(run.err().begin(), run.err().end(), '\n') == 1);
    CHECK_FALSE(std::filesystem::exists(run.path("result")));
  };
  check("--plugin missing.so", 1, "visp-servo-compare: missing.so: no such file\n");
  check("--plugin text.so", 1, "visp-servo-compare: text.so: cannot be loaded: ");
  check("--plugin", 2, "--plugin is given without a value");
  check(PLUGIN_OPTION + PLUGIN_OPTION, 1, "servo law \"again\" is registered already");
  check(PLUGIN_OPTION + "--law agin", 2, "unknown law \"agin\"; known are pbvs1, ");
  check(PLUGIN_OPTION + "--law late --plant A --measure points", 1, "law late has no weights");
}
