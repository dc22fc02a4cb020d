/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-servo with Aravis's fake camera on the loopback interface: images at their rate with time stamps, and no target in them.
#include "vpCatch.h"

#include "programRun.h"

#include <arv.h>

#include <nlohmann/json.hpp>

#include <memory>

TEST_CASE("visp-servo watches a GigE camera", "[visp-servo][aravis]")
{
  struct Unref {
    void operator()(void *object) const { g_object_unref(object); }
  };
  const std::unique_ptr<ArvGvFakeCamera, Unref> camera(arv_gv_fake_camera_new("127.0.0.1", "GV78"));
  if (!camera || !arv_gv_fake_camera_is_running(camera.get())) {
    vpTestSupport::skip("Aravis's fake camera does not run here: is its port in use?");
    return;
  }
  ProgramRun run(SERVO);
  REQUIRE(run("--camera aravis:127.0.0.1 --camera-rate 20 --duration 3 --out a") == 0);
  const auto summary = nlohmann::json::parse(vpApp::readFile(run.path("a/summary.json")));
  CHECK(summary["clock"] == "time stamps of the camera");
  CHECK(summary["images"].get<int>() > 20); // of 60; the machine may be busy
  CHECK(summary["times"]["image_period"]["median_ms"].get<double>() == Approx(50.).epsilon(0.3)); // likewise
  CHECK(summary["images_found"] == 0);
  CHECK(summary["images_lost"].get<int>() >= 0);
  CHECK(run.out().find("At the end the target was not seen") != std::string::npos);
  CHECK(run.out().find("a field of view of 60 degrees was assumed") != std::string::npos);
}
