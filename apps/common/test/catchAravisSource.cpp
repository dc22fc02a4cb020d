/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// GigE Vision through Aravis: its fake camera on the loopback interface.
#include "vpCatch.h"

#include "imageSource.h"

#include <arv.h>

#include <cmath>
#include <memory>

namespace
{
using namespace vpApp;

struct Unref {
  void operator()(void *object) const { g_object_unref(object); }
};
using FakeCamera = std::unique_ptr<ArvGvFakeCamera, Unref>;
constexpr const char *LOOPBACK = "127.0.0.1";

FakeCamera fakeCamera(double lostPackets = 0.)
{
  FakeCamera camera(arv_gv_fake_camera_new(LOOPBACK, "GV77"));
  if (camera && !arv_gv_fake_camera_is_running(camera.get())) {
    camera.reset();
  }
  if (!camera) {
    vpTestSupport::skip("Aravis's fake camera does not run here: is its port in use?");
  }
  else if (lostPackets > 0.) {
    g_object_set(camera.get(), "gvsp-lost-ratio", lostPackets, nullptr);
  }
  return camera;
}
} // namespace

TEST_CASE("Aravis: images come at their rate with the camera's own times", "[sources][aravis]")
{
  const FakeCamera camera = fakeCamera();
  if (!camera) {
    return;
  }
  const std::unique_ptr<ImageSource> source = openAravis(LOOPBACK, 50., 60);
  CHECK(source->isLive());
  vpImage<unsigned char> image;
  double before = 0., worstPeriod = 0., worstAge = 0.;
  std::size_t read = 0;
  while (source->next(image)) {
    ++read;
    const double age = now() - source->time();
    CHECK(age >= 0.);
    worstAge = std::max(worstAge, age);
    if (read > 10) { // the first images of the fake camera find their rate
      worstPeriod = std::max(worstPeriod, std::fabs(source->time() - before - 0.02));
    }
    before = source->time();
  }
  CHECK(read == 60);
  CHECK(image.getWidth() == 512);
  CHECK(image.getHeight() == 512);
  CHECK(source->clock() == "time stamps of the camera");
  CHECK(source->lost() < 6);
  CHECK(worstPeriod < 0.5); // wide: other programs may take the processor
  CHECK(worstAge < 1.);
}

TEST_CASE("Aravis: images that do not arrive whole are counted", "[sources][aravis]")
{
  const FakeCamera camera = fakeCamera(0.002);
  if (!camera) {
    return;
  }
  const std::unique_ptr<ImageSource> source = openAravis(LOOPBACK, 50., 30);
  vpImage<unsigned char> image;
  std::size_t read = 0, gaps = 0;
  while (source->next(image)) {
    ++read;
    gaps += source->isAfterGap() ? 1 : 0;
  }
  CHECK(read == 30);
  WARN(source->lost() << " of " << source->lost() + read << " images lost");
  CHECK(source->lost() > 0);
  CHECK(gaps > 0);
  REQUIRE(source->remarks().size() == 1);
  CHECK(source->remarks()[0].find(std::to_string(source->lost())) != std::string::npos);
}

TEST_CASE("Aravis: a camera that is not there is one sentence", "[sources][aravis]")
{
  const auto complaint = [](const std::string &id) {
    try {
      (void)openAravis(id);
    }
    catch (const std::runtime_error &error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  CHECK(complaint("No-Such-Camera").find("aravis:No-Such-Camera: the camera cannot be opened; Aravis sees ") == 0);
}

TEST_CASE("Aravis: a camera that is unplugged is one sentence", "[sources][aravis]")
{
  if (vpTestSupport::longer(1) == 1) { // Aravis asks the camera many times before it lets go of it
    return;
  }
  FakeCamera camera = fakeCamera();
  if (!camera) {
    return;
  }
  const std::unique_ptr<ImageSource> source = openAravis(LOOPBACK);
  vpImage<unsigned char> image;
  REQUIRE(source->next(image));
  camera.reset();
  std::string sentence;
  try {
    while (source->next(image)) {
    }
  }
  catch (const std::runtime_error &error) {
    sentence = error.what();
  }
  CHECK(sentence.find("the camera gives no image after ") != std::string::npos);
}
