/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The motion, the table of fields, and tasks as files.
#include "vpCatch.h"
#include "vpFieldRows.h"

#include "outputFolder.h"
#include "task.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace
{
using namespace generatePattern;

//! \brief A file that is removed afterwards.
class TemporaryFile
{
public:
  explicit TemporaryFile(const std::string &content)
    : m_path(std::filesystem::temp_directory_path() / ("generate-pattern-" + std::to_string(getpid()) + ".json"))
  {
    std::ofstream(m_path) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(m_path); }
  TemporaryFile(const TemporaryFile &) = delete;
  TemporaryFile &operator=(const TemporaryFile &) = delete;
  [[nodiscard]] std::string path() const { return m_path.string(); }

private:
  std::filesystem::path m_path;
};

std::string refusalOf(const std::string &content)
{
  const TemporaryFile file(content);
  try {
    static_cast<void>(readTask(file.path()));
  }
  catch (const std::exception &error) {
    const std::string sentence = error.what();
    return sentence.compare(0, file.path().size(), file.path()) == 0 ? sentence.substr(file.path().size() + 2)
                                                                     : "without the file's name: " + sentence;
  }
  return "accepted";
}
} // namespace

TEST_CASE("The velocity is the derivative of the place", "[visp-generate-pattern]")
{
  auto rng = vpTestSupport::generator(1);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> unit(-1., 1.);
  for (int problem = 0; problem < 100; ++problem) {
    const Motion motion{
        {{9. * unit(rng), unit(rng)}}, {{unit(rng), unit(rng)}}, {{unit(rng), 5. * unit(rng)}}, 10. + 5. * unit(rng)};
    const double t = 50. * unit(rng), h = 1e-4;
    for (const std::size_t k : {0U, 1U}) {
      const double slope = (motion.placeAt(t + h)[k] - motion.placeAt(t - h)[k]) / (2. * h);
      CHECK(motion.velocityAt(t)[k] == Approx(slope).margin(1e-7));
      CHECK(motion.placeAt(0.)[k] == motion.start[k]);
      const double turns = motion.placeAt(motion.period)[k] - motion.start[k] - motion.velocity[k] * motion.period;
      CHECK(turns == Approx(0.).margin(1e-12));
    }
  }
}

TEST_CASE("A task survives being written and read", "[visp-generate-pattern]")
{
  auto rng = vpTestSupport::generator(2);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> unit(0., 1.);
  Task task;
  for (const auto &field : vpProductPatternSpec::fields()) { // a small change of each, to detect a forgotten field
    field.set(task.product, field.of(task.product) * 0.9 + 1e-3 * unit(rng));
  }
  task.product.shape = vpProductShape::Dot;
  task.product.rotation = 0.123;
  task.motion = {{{1., 2.}}, {{3., 4.}}, {{5., 6.}}, 7.};
  task.frames = 8;
  const TemporaryFile file(jsonOf(task).dump());
  const Task again = readTask(file.path());
  CHECK(jsonOf(again) == jsonOf(task));
  CHECK(again.product.shape == vpProductShape::Dot);
  CHECK(again.product.rotation == Approx(0.123).epsilon(1e-14));
  CHECK(again.product.pitchX == task.product.pitchX);
  CHECK(again.product.width == task.product.width);
  CHECK(again.motion.swing == task.motion.swing);
  CHECK(again.frames == 8);
}

TEST_CASE("The example is read, an empty object is the default", "[visp-generate-pattern]")
{
  const Task oled = readTask(std::string(VISP_DIRECT_DATA_DIR) + "/pattern/oled.json");
  CHECK(oled.product.pitchX == Approx(220. / 4.5).epsilon(1e-6));
  CHECK(oled.product.noise == 4.);
  CHECK(oled.motion.swing[1] == 1.);
  const TemporaryFile file("{}");
  CHECK(jsonOf(readTask(file.path())) == jsonOf(Task()));

  const std::string page = vpApp::readFile(std::string(VISP_DIRECT_DATA_DIR) + "/pattern/README.md");
  for (const FieldGroup &group : fieldGroups()) {
    CHECK(vpTestSupport::missingRows(page, group.name + ".", group.fields, Task().product, false) == "");
  }
}

TEST_CASE("A file is refused by field and value", "[visp-generate-pattern]")
{
  const std::vector<std::pair<std::string, std::string>> cases = {
      {R"({"cells": {"pitch_x": -3}})", "cells.pitch_x is -3, must be 2..100000 px"},
      {R"({"cells": {"pitch_x": "wide"}})", "cells.pitch_x is \"wide\", must be a number"},
      {R"({"cells": {"pitchX": 3}})", "unknown field cells.pitchX; known are "},
      {R"({"cells": {"shape": "star"}})", "cells.shape is \"star\", must be rectangle, rounded or dot"},
      {R"({"cells": {"rotation_deg": 200}})", "cells.rotation_deg is 200 degrees, must be -180..180"},
      {R"({"image": {"width": 160.5}})", "image.width is 160.5, must be a whole number >= 0"},
      {R"({"image": {"width": 4}})", "image.width is 4, must be 8..16384 px"},
      {R"({"camera": 3})", "camera is 3, must be an object"},
      {R"({"flexible": {"jitter": 1.5}})", "cells.opening_y is 11.55555556 px, must be < 8.777778 px, what pitch"},
      {R"({"defects": {"missing": 0.8, "damaged": 0.4}})", "missing + damaged is 1.2, must be 0..1"},
      {R"({"motion": {"velocity": [1]}})", "motion.velocity is [1], must be a list of 2 numbers"},
      {R"({"motion": {"velocity": [1e5, 0]}})", "motion.velocity is 100000 0 px/frame, must move the product by at"},
      {R"({"motion": {"start": [1e9, 0]}})", "motion.velocity is 5 0 px/frame, must keep the product within 1e8"},
      {R"({"motion": {"swing_period": 0}})", "motion.swing_period is 0 frames, must be 2..1e9"},
      {R"({"frames": 0})", "frames is 0, must be 1..1000000"},
      {R"({"frames": 3, "frames": 4})", "field \"frames\" is given twice"},
      {R"({"frames": 3)", "line 1, column"},
      {R"([])", "the content is [], must be an object"},
  };
  for (const auto &[content, sentence] : cases) {
    CAPTURE(content, refusalOf(content));
    CHECK(refusalOf(content).find(sentence) == 0);
  }
}
