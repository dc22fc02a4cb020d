/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"
#include "vpPlanarScene.h"

#include <visp3/planar_target/vpPlanarTargetDatabase.h>

#include <filesystem>
#include <fstream>

namespace
{
namespace fs = std::filesystem;

std::string dataFolder() { return std::string(VISP_DIRECT_DATA_DIR) + "/target"; }

// A folder for this test only, removed at its end.
class Folder
{
public:
  Folder()
    : m_path(fs::temp_directory_path() / ("vp-targets-" + std::to_string(vpTestSupport::generator(77)() % 1000000)))
  {
    fs::remove_all(m_path);
    fs::create_directories(m_path);
  }
  ~Folder() { fs::remove_all(m_path); }
  std::string path() const { return m_path.string(); }
  void write(const std::string &name, const std::string &content) const { std::ofstream(m_path / name) << content; }

private:
  fs::path m_path;
};
} // namespace

TEST_CASE("three targets are found, followed and told apart in one frame", "[database]")
{
  CAPTURE(vpTestSupport::seed());
  vpPlanarTargetDatabase database = vpPlanarTargetDatabase::fromFolder(dataFolder(), vpPlanarScene::camera());
  REQUIRE(database.size() == 3);
  CHECK(database.sightings()[0].result.status == vpPlanarTargetStatus::NoFrame);

  auto rng = vpTestSupport::generator(11);
  // Side by side at 0.8 m: each covers about a quarter of the view.
  const double x[3] = {-0.17, 0.13, -0.10}, y[3] = {-0.11, -0.11, 0.13};
  for (int frame = 0; frame < 3; ++frame) {
    vpPlanarScene::Image I = vpPlanarScene::background(rng);
    std::vector<vpHomogeneousMatrix> truth;
    for (std::size_t i = 0; i < 3; ++i) {
      const vpPlanarTargetSighting &s = database.sightings()[i];
      const std::string file = s.name + (s.name == "box" ? ".png" : ".jpg");
      truth.push_back(vpPlanarScene::pose(x[i] + 0.004 * frame, y[i], 0.8, 0.05 * frame, 0.2, -0.15));
      vpPlanarScene::draw(I, {vpPlanarScene::photo(file), s.width, s.height}, vpPlanarScene::camera(), truth.back());
    }
    const std::vector<vpPlanarTargetSighting> &seen = database.process(I);
    for (std::size_t i = 0; i < 3; ++i) {
      CAPTURE(frame, seen[i].name, seen[i].result.message);
      REQUIRE(seen[i].result.status == (frame == 0 ? vpPlanarTargetStatus::Acquired : vpPlanarTargetStatus::Tracked));
      CHECK(vpPlanarScene::positionError(truth[i], seen[i].result.cMo) < 2e-3);
      CHECK(std::sqrt(vpPlanarScene::rotationError(truth[i], seen[i].result.cMo).sumSquare()) < 0.5);
    }
  }
  // One target is removed: the others stay, the missing one is not reported.
  vpPlanarScene::Image I = vpPlanarScene::background(rng);
  const vpPlanarTargetSighting first = database.sightings()[0];
  vpPlanarScene::draw(I, {vpPlanarScene::photo("klimt.jpg"), first.width, first.height}, vpPlanarScene::camera(),
                      first.result.cMo);
  database.process(I);
  CHECK(database.sightings()[0].result.found());
  CHECK_FALSE(database.sightings()[1].result.found());
  CHECK_FALSE(database.sightings()[2].result.found());

  database.reset();
  CHECK(database.sightings()[0].result.status == vpPlanarTargetStatus::NoFrame);
  database.process(vpPlanarScene::Image(8, 8));
  CHECK(database.sightings()[2].result.status == vpPlanarTargetStatus::NoTexture);
}

TEST_CASE("what is wrong with a folder of targets is said in a sentence", "[database][errors]")
{
  using Catch::Contains;
  const Folder folder;
  const auto load = [&]() { return vpPlanarTargetDatabase::fromFolder(folder.path(), vpPlanarScene::camera()); };
  const auto list = [&](const std::string &entry) {
    folder.write("targets.json", "{ \"targets\": [ " + entry + " ] }");
  };

  CHECK_THROWS_WITH(vpPlanarTargetDatabase::fromFolder(folder.path() + "/none", vpPlanarScene::camera()),
                    Contains("is not a folder"));
  CHECK_THROWS_WITH(load(), Contains("targets.json: cannot be read"));
  folder.write("targets.json", "{ \"targets\": [");
  CHECK_THROWS_WITH(load(), Contains("targets.json: line 1, column 15: syntax error"));
  folder.write("targets.json", "{ \"targets\": [] }");
  CHECK_THROWS_WITH(load(), Contains("targets is [], must be a list of at least one object"));
  list(R"({ "name": "a", "image": "a.png", "width_m": -0.1 })");
  CHECK_THROWS_WITH(load(), Contains("targets[0].width_m is -0.1, must be a number > 0"));
  list(R"({ "name": "a", "image": "a.png" })");
  CHECK_THROWS_WITH(load(), Contains("targets[0].width_m is missing"));
  list(R"({ "name": "", "image": "a.png", "width_m": 0.1 })");
  CHECK_THROWS_WITH(load(), Contains("targets[0].name is \"\", must be a text"));
  list(R"({ "name": "a", "image": "a.png", "width_m": 0.1, "size": 3 })");
  CHECK_THROWS_WITH(load(), Contains("unknown field targets[0].size; known are"));
  list(R"({ "name": "a", "image": "a.png", "width_m": 0.1 })");
  CHECK_THROWS_WITH(load(), Contains("a.png: cannot be read"));
  folder.write("a.png", "no image");
  CHECK_THROWS_WITH(load(), Contains("a.png: is not an image that can be read"));

  vpPlanarScene::Image blank(64, 64, 100);
  vpImageIo::write(blank, folder.path() + "/a.png");
  CHECK_THROWS_WITH(load(), Contains("a.png: target 'a': reference image is blank"));
  fs::copy_file(dataFolder() + "/box.png", folder.path() + "/b.png");
  list(R"({ "name": "b", "image": "b.png", "width_m": 0.1 })");
  CHECK_THROWS_WITH(load(), Contains("does not list the photograph a.png"));
  list(R"({ "name": "b", "image": "b.png", "width_m": 0.1 }, { "name": "b", "image": "b.png", "width_m": 0.1 })");
  fs::remove(folder.path() + "/a.png");
  CHECK_THROWS_WITH(load(), Contains("has a target 'b' already"));
  list(R"({ "name": "\u202eb", "image": "b.png", "width_m": 1e19 })"); // would turn the direction of the text
  CHECK_THROWS_WITH(load(), Contains("target '\\u202eb': size of the target is 1e+19 x"));
  list(R"({ "name": "b", "image": "b.png", "width_m": 0.324 })");
  CHECK(load().sightings()[0].height == Approx(0.223)); // from the aspect ratio of 324 x 223 px
  CHECK(load().sightings()[0].depth == 0.);
  list(R"({ "name": "b", "image": "b.png", "width_m": 0.1, "depth_m": 0 })");
  CHECK_THROWS_WITH(load(), Contains("targets[0].depth_m is 0.0, must be a number > 0"));
  list(R"({ "name": "b", "image": "b.png", "width_m": 0.1, "depth_m": 0.07 })");
  vpPlanarTargetDatabase database = load();
  CHECK(database.sightings()[0].depth == 0.07);
  CHECK_THROWS_WITH(database.add("c", vpPlanarScene::photo("box.png"), 0.1, 0.1, -1.),
                    Contains("target 'c': depth is -1 m, must be >= 0"));
}

TEST_CASE("a target is followed through large motions of the camera when these are told", "[database]")
{
  auto rng = vpTestSupport::generator(12);
  CAPTURE(vpTestSupport::seed());
  vpPlanarTargetDatabase told(vpPlanarScene::camera()), untold(vpPlanarScene::camera());
  const vpPlanarScene::Target klimt = vpPlanarScene::klimt();
  told.add("klimt", klimt.image, klimt.width, klimt.height);
  untold.add("klimt", klimt.image, klimt.width, klimt.height);
  vpHomogeneousMatrix cMo = vpPlanarScene::pose(-0.05, 0.02, 0.6, 0.1, 0.2, -0.1);
  int followed = 0;
  for (int frame = 0; frame < 4; ++frame) {
    const vpHomogeneousMatrix moved = vpPlanarScene::pose(frame % 2 == 0 ? 0.06 : -0.06, 0.03 * (frame - 1.5), 0.02,
                                                          frame % 2 == 0 ? 0.25 : -0.25, 0., 0.05);
    if (frame > 0) {
      cMo = moved * cMo;
      told.predict(0, moved * told.sightings()[0].result.cMo);
      vpHomogeneousMatrix broken = moved;
      broken[0][3] = std::nan("");
      told.predict(0, broken); // ignored
      told.predict(1, moved);  // there is none
    }
    vpPlanarScene::Image I = vpPlanarScene::background(rng);
    vpPlanarScene::draw(I, klimt, vpPlanarScene::camera(), cMo);
    const vpPlanarTargetResult seen = told.process(I)[0].result;
    CAPTURE(frame, seen.message);
    REQUIRE(seen.status == (frame == 0 ? vpPlanarTargetStatus::Acquired : vpPlanarTargetStatus::Tracked));
    CHECK(vpPlanarScene::positionError(cMo, seen.cMo) < 2e-3);
    followed += untold.process(I)[0].result.status == vpPlanarTargetStatus::Tracked ? 1 : 0;
  }
  CHECK(followed < 3); // without the prediction it is lost and must be acquired again
}
