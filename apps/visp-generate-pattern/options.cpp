/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "appMain.h"

#include <CLI/CLI.hpp>

#include <visp3/core/vpMath.h>

#include <functional>

namespace generatePattern
{
namespace
{
constexpr const char *ABOUT =
    R"(Write sequences of a repetitive, flexible product in motion, with the true places of its cells, to qualify optics
and trackers. The defaults are the display of chapter 7 of the thesis: 160 x 100 px, 4.5 um a pixel, openings of
178 x 52 um every 220 x 80 um. Places are pixels; (0, 0) is the centre of the top left one.)";

constexpr const char *EXAMPLES =
    R"(Examples:
  visp-generate-pattern
      100 frames at 5 px/frame in out/generate-pattern
  visp-generate-pattern --noise 4 --dust 7.5 --cracks 2 --jitter 0.3 --rotation 1.5 --out hard --video
      the thesis's noise on a dirty, turned product, and a video of it
  visp-generate-pattern --config data/pattern/oled.json --width 2048 --height 2048 --frames 10
      a file, and options that go before it; data/pattern/README.md describes the file and what is written

Exit status: 0 done, 1 the file or the disk does not allow it, 2 the command line is wrong.)";

constexpr std::size_t NAME_COLUMN = 34; // width, characters

std::string headingOf(const std::string &group)
{
  static const std::vector<std::pair<std::string, std::string>> headings = {
      {"image", "Image"},   {"cells", "Cells"},     {"flexible", "Flexible product"},
      {"camera", "Camera"}, {"defects", "Defects"}, {"random", "Randomness"}};
  for (const auto &[name, heading] : headings) {
    if (name == group) {
      return heading;
    }
  }
  return group;
}

//! Changes to the task applied after the file, in command-line order.
using Changes = std::vector<std::function<void(Task &)>>;

void addField(CLI::App &app, const Field &field, Changes &changes)
{
  const std::string sentence =
      std::string(field.sentence) + " (default: " + field.valueOf(vpProductPatternSpec()) + ")";
  std::visit(
      [&](auto pointer) {
        using Number = std::remove_reference_t<decltype(std::declval<vpProductPatternSpec>().*pointer)>;
        app.add_option_function<Number>(
               "--" + field.nameWith('-'),
               [&changes, pointer](const Number &value) {
                 changes.emplace_back([pointer, value](Task &task) { task.product.*pointer = value; });
               },
               sentence)
            ->option_text(field.unit)
            ->group(headingOf(field.group));
      },
      field.member);
}

void addPair(CLI::App &app, const char *name, Pair Motion::*member, const char *text, const char *sentence,
             Changes &changes)
{
  app.add_option_function<std::vector<double>>(
         name,
         [&changes, member](const std::vector<double> &value) {
           changes.emplace_back([member, value](Task &task) { task.motion.*member = {{value[0], value[1]}}; });
         },
         sentence)
      ->expected(2)
      ->option_text(text)
      ->group("Motion");
}

void addShape(CLI::App &app, Changes &changes)
{
  app.add_option_function<std::string>(
         "--shape",
         [&changes](const std::string &name) {
           changes.emplace_back([name](Task &task) {
             try {
               task.product.shape = shapeOf(name);
             }
             catch (const std::runtime_error &error) {
               throw std::runtime_error(std::string("--shape is ") + error.what());
             }
           });
         },
         "rectangle, rounded or dot (default: rounded)")
      ->option_text("NAME")
      ->group(headingOf("cells"));
  app.add_option_function<double>(
         "--rotation",
         [&changes](const double &degrees) {
           changes.emplace_back([degrees](Task &task) { task.product.rotation = vpMath::rad(degrees); });
         },
         "Of the product in the image, clockwise (default: 0)")
      ->option_text("DEGREES")
      ->group(headingOf("cells"));
}

void addMotion(CLI::App &app, Changes &changes)
{
  app.add_option_function<unsigned int>(
         "--frames",
         [&changes](const unsigned int &frames) {
           changes.emplace_back([frames](Task &task) { task.frames = frames; });
         },
         "Length of the sequence (default: 100)")
      ->option_text("N")
      ->group("Motion");
  addPair(app, "--motion", &Motion::velocity, "VX VY", "Velocity of the product, px/frame (default: 5 0)", changes);
  addPair(app, "--swing", &Motion::swing, "AX AY", "Amplitude of a sine that is added, px (default: 0 0)", changes);
  app.add_option_function<double>(
         "--swing-period",
         [&changes](const double &period) {
           changes.emplace_back([period](Task &task) { task.motion.period = period; });
         },
         "Its period (default: 50)")
      ->option_text("FRAMES")
      ->group("Motion");
  addPair(app, "--start", &Motion::start, "X Y", "Displacement in frame 0, px (default: 0 0)", changes);
}
} // namespace

bool readOptions(int argc, const char *const *argv, Options &options)
{
  CLI::App app(ABOUT, "visp-generate-pattern");
  app.get_formatter()->column_width(NAME_COLUMN);
  app.footer(EXAMPLES);
  std::string config;
  app.add_option("--config", config, "Read the sequence from a file; other options go before it")
      ->option_text("FILE.json");
  app.add_option("--out", options.out, "Folder for the result (default: out/generate-pattern)")->option_text("DIR");
  app.add_option("--format", options.format, "Of the frames: png or pgm (default: png)")->option_text("NAME");
  app.add_flag("--video", options.video, "Write video.mp4 too");
  app.add_option("--video-rate", options.videoRate, "Frames per second of the video (default: 25)")->option_text("HZ");
  Changes changes;
  addMotion(app, changes);
  addShape(app, changes);
  for (const Field &field : fields()) {
    addField(app, field, changes);
  }
  if (!vpApp::parseCommandLine(app, argc, argv)) {
    return false;
  }
  if (options.format != "png" && options.format != "pgm") {
    throw vpApp::UsageError("--format is " + options.format + ", must be png or pgm");
  }
  if (!(options.videoRate >= 1. && options.videoRate <= 240.)) {
    throw vpApp::UsageError("--video-rate is " + shortNumber(options.videoRate) + ", must be 1..240");
  }
  if (!config.empty()) {
    options.task = readTask(config);
  }
  try {
    for (const auto &change : changes) {
      change(options.task);
    }
    check(options.task, Naming::CommandLine);
  }
  catch (const std::runtime_error &error) {
    throw vpApp::UsageError(error.what());
  }
  return true;
}
} // namespace generatePattern
