/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "appMain.h"
#include "commandLine.h"

#include <visp3/core/vpMath.h>

#include <algorithm>
#include <cctype>

namespace generatePattern
{
namespace
{
constexpr const char *ABOUT =
    R"(Write sequences of a repetitive, flexible product in motion, with the true positions of its cells, to qualify optics
and trackers. The defaults are the display of chapter 7 of the thesis: 160 x 100 px, 4.5 um a pixel, openings of
178 x 52 um every 220 x 80 um. Positions are in pixels; (0, 0) is the centre of the top left one.)";

constexpr const char *EXAMPLES =
    R"(Examples:
  visp-generate-pattern
      100 frames at 5 px/frame in out/generate-pattern
  visp-generate-pattern --noise 4 --dust 7.5 --cracks 2 --jitter 0.3 --rotation 1.5 --out hard --video
      the noise of the thesis on a dirty, rotated product, and a video
  visp-generate-pattern --config data/pattern/oled.json --width 2048 --height 2048 --frames 10
      a file, and options that go before it; data/pattern/README.md describes the file and what is written

Exit status: 0 done, 1 the file or the disk does not allow it, 2 the command line is wrong.)";

void addField(vpApp::CommandLine &line, const vpField<vpProductPatternSpec> &field, vpProductPatternSpec &product)
{
  const std::string name = "--" + optionNameOf(field),
                    description = std::string(field.description) + ", " + field.range.text();
  std::string unit = *field.unit == '\0' ? "N" : field.unit;
  std::transform(unit.begin(), unit.end(), unit.begin(), [](unsigned char c) { return std::toupper(c); });
  if (const auto *real = std::get_if<double vpProductPatternSpec::*>(&field.member)) {
    line.number(name, product.**real, {}, unit, description); // check() has the ranges
  }
  else {
    line.whole(name, product.*std::get<unsigned int vpProductPatternSpec::*>(field.member), {0, 4294967295.}, unit,
               description);
  }
}

void addPair(vpApp::CommandLine &line, const std::string &name, Pair &value, const char *text, const char *sentence)
{
  line.add(
      name, text, sentence, shortNumber(value[0]) + " " + shortNumber(value[1]),
      [&value, name](const auto &texts) {
        value = {{vpApp::numberIn(name, texts[0], {}), vpApp::numberIn(name, texts[1], {})}};
      },
      2);
}

void addTask(vpApp::CommandLine &line, Task &task)
{
  line.group("Motion");
  line.whole("--frames", task.frames, {1, 1e6}, "N", "Length of the sequence");
  addPair(line, "--motion", task.motion.velocity, "VX VY", "Velocity of the product, px/frame");
  addPair(line, "--swing", task.motion.swing, "AX AY", "Amplitude of a sine that is added, px");
  line.number("--swing-period", task.motion.period, {}, "FRAMES", "Period of that sine");
  addPair(line, "--start", task.motion.start, "X Y", "Displacement in frame 0, px");
  line.group("Cells");
  line.choice<vpProductShape>("--shape", task.product.shape,
                              {{vpToString(vpProductShape::Rectangle), vpProductShape::Rectangle},
                               {vpToString(vpProductShape::Rounded), vpProductShape::Rounded},
                               {vpToString(vpProductShape::Dot), vpProductShape::Dot}},
                              "Shape of an opening");
  line.add("--rotation", "DEGREES", "Rotation of the product in the image, clockwise, degrees, -180 to 180", "0",
           [&task](const auto &values) {
             task.product.rotation = vpMath::rad(vpApp::numberIn("--rotation", values[0], {-180., 180.}));
           });
  for (const FieldGroup &group : fieldGroups()) {
    line.group(group.heading);
    for (const auto &field : group.fields) {
      addField(line, field, task.product);
    }
  }
}

// Twice: the file comes first, and what is on the command line goes before it.
bool parse(int argc, const char *const *argv, Options &options, std::string &config)
{
  vpApp::CommandLine line("visp-generate-pattern", ABOUT, EXAMPLES);
  line.group("Files");
  line.text("--config", config, "FILE.json", "Read the sequence from a file; other options go before it");
  line.text("--out", options.out, "DIR", "Folder for the result");
  line.choice("--format", options.format, {{"png", std::string("png")}, {"pgm", std::string("pgm")}},
              "Format of the frames");
  line.flag("--video", options.video, "Write video.mp4 too");
  line.number("--video-rate", options.videoRate, {1., 240.}, "HZ", "Frames per second of the video");
  addTask(line, options.task);
  return line.parse(argc, argv);
}
} // namespace

bool readOptions(int argc, const char *const *argv, Options &options)
{
  std::string config;
  if (!parse(argc, argv, options, config)) {
    return false;
  }
  if (!config.empty()) {
    options.task = readTask(config);
    static_cast<void>(parse(argc, argv, options, config));
  }
  try {
    check(options.task, Naming::CommandLine);
  }
  catch (const std::runtime_error &error) {
    throw vpApp::UsageError(error.what());
  }
  return true;
}
} // namespace generatePattern
