/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Many targets, most of them missing: the work per frame is bounded, and returning ones are found within a second.
#include "vpCatch.h"
#include "vpPosters.h"

#include <visp3/planar_target/vpPlanarTargetDatabase.h>

#include <algorithm>

namespace
{
constexpr unsigned int second = 30; // frames

struct Gallery {
  std::vector<vpPlanarScene::Target> posters;
  vpPlanarTargetDatabase database;

  Gallery(std::size_t count, std::mt19937_64 &rng) : database(vpPlanarScene::camera())
  {
    for (std::size_t i = 0; i < count; ++i) {
      posters.push_back(vpPosters::poster(rng));
      database.add("poster " + std::to_string(i), posters[i].image, posters[i].width, posters[i].height);
    }
  }
};

vpHomogeneousMatrix placeOf(std::mt19937_64 &rng, double x, double angle)
{
  std::uniform_real_distribution<double> u(-1., 1.);
  return vpPlanarScene::pose(x + 0.01 * u(rng), 0.03 * u(rng), 0.6 + 0.08 * u(rng), 3. * angle * u(rng), angle * u(rng),
                             angle * u(rng));
}

// Bounds of vpPlanarTargetEffort, from the sightings.
void checkEffort(const vpPlanarTargetDatabase &database, const std::vector<bool> &known)
{
  const vpPlanarTargetEffort &effort = database.effort();
  unsigned int followed = 0, lost = 0, again = 0;
  for (std::size_t i = 0; i < database.size(); ++i) {
    const vpPlanarTargetStatus status = database.sightings()[i].result.status;
    followed += known[i] ? 1 : 0;
    again += status == vpPlanarTargetStatus::Acquired ? 1 : 0;
    lost += status == vpPlanarTargetStatus::Tracked ? 0 : 1;
  }
  CHECK(effort.followed == followed);
  CHECK(effort.extractions == (lost > 0 ? 1 : 0));
  CHECK(effort.probed <= lost);
  CHECK(effort.searches <= again + 1);
  CHECK((effort.comparisons <= 20'800'000 || effort.probed == 1));
}
} // namespace

TEST_CASE("the work of a frame is bounded however many targets are lost", "[search]")
{
  CAPTURE(vpTestSupport::seed());
  auto rng = vpTestSupport::generator(1);
  const auto count = static_cast<std::size_t>(vpTestSupport::longer(24));
  Gallery gallery(count, rng);
  unsigned int mostProbed = 0;
  for (int frame = 0; frame < 24; ++frame) {
    CAPTURE(frame);
    std::vector<bool> known;
    for (const vpPlanarTargetSighting &sighting : gallery.database.sightings()) {
      known.push_back(sighting.result.found());
    }
    // In turn: only clutter, one of them, another one, none, an empty wall.
    vpPlanarScene::Image view = vpPosters::wall(rng);
    if (frame % 8 < 6) {
      vpPlanarScene::draw(view, gallery.posters[static_cast<std::size_t>(frame / 8) % count], vpPlanarScene::camera(),
                          placeOf(rng, 0.002 * frame, 0.05));
    }
    gallery.database.process(frame % 8 == 7 ? vpPlanarScene::Image(480, 640, 90) : view);
    checkEffort(gallery.database, known);
    mostProbed = std::max(mostProbed, gallery.database.effort().probed);
  }
  CHECK(mostProbed >= std::min<std::size_t>(20, count - count / 6)); // it is a bound, not zero
}

namespace
{
/*
 * One target is always there and keeps being tracked; another comes, in a view in which it can be acquired at once when it is the
 * only one that is looked for. Returns the frames until each is found.
 */
std::vector<unsigned int> framesUntilFound(Gallery &gallery, int trials, std::mt19937_64 &rng)
{
  std::vector<unsigned int> found;
  const std::size_t count = gallery.posters.size();
  for (int trial = 0; trial < trials; ++trial) {
    const std::size_t there = rng() % count, comes = (there + 1 + rng() % (count - 1)) % count;
    const vpHomogeneousMatrix still = placeOf(rng, -0.12, 0.2), place = placeOf(rng, 0.12, 0.4);
    const vpPlanarScene::Image wall = vpPosters::wall(rng);
    gallery.database.reset();
    const auto frameOf = [&](bool both) {
      vpPlanarScene::Image view = wall;
      vpPlanarScene::draw(view, gallery.posters[there], vpPlanarScene::camera(), still);
      if (both) {
        vpPlanarScene::draw(view, gallery.posters[comes], vpPlanarScene::camera(), place);
      }
      vpPlanarScene::spoil(view, trial % 2 == 0 ? 0.7 : 2.2, 0.9, 2., rng);
      return view;
    };
    const vpPlanarScene::Image with = frameOf(true), without = frameOf(false);
    vpPlanarTarget alone(gallery.posters[comes].image, 0.15, 0.15, vpPlanarScene::camera());
    if (!alone.acquire(with).found()) {
      continue;
    }
    for (unsigned int frame = 0; frame < second + trial % 7; ++frame) { // the turns are anywhere
      gallery.database.process(without);
    }
    CAPTURE(trial, there, comes);
    REQUIRE_FALSE(gallery.database.sightings()[comes].result.found());
    unsigned int frames = 0;
    // Where blur makes it look like nothing known, its turn comes after three times as many frames as there are targets.
    const unsigned int promised =
        trial % 2 == 0 ? second : std::max<unsigned int>(second, 3 * static_cast<unsigned int>(count));
    while (frames < promised && !gallery.database.sightings()[comes].result.found()) {
      gallery.database.process(with);
      ++frames;
    }
    CHECK(gallery.database.sightings()[comes].result.found());
    CHECK(vpPlanarScene::positionError(place, gallery.database.sightings()[comes].result.cMo) < 5e-3);
    found.push_back(frames);
  }
  return found;
}
} // namespace

TEST_CASE("with all but one of 10 or 100 targets lost, each that comes back is found within a second, or a blurred one "
          "in its turn",
          "[search]")
{
  CAPTURE(vpTestSupport::seed());
  const std::size_t count = GENERATE(std::size_t(10), std::size_t(100));
  CAPTURE(count);
  auto rng = vpTestSupport::generator(2);
  Gallery gallery(count, rng);
  const std::vector<unsigned int> found = framesUntilFound(gallery, vpTestSupport::longer(6), rng);
  REQUIRE_FALSE(found.empty());
  WARN(count << " targets: the slowest of " << found.size() << " after "
             << *std::max_element(found.begin(), found.end()) << " frames, "
             << std::count_if(found.begin(), found.end(), [](unsigned int n) { return n > 6; })
             << " after more than 6");
}
