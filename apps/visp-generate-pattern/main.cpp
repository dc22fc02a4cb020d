/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-generate-pattern: images of a moving repetitive product, with the true positions of its cells.
#include "options.h"

#include "appMain.h"
#include "outputFolder.h"
#include "progress.h"
#include "videoFile.h"

#include <visp3/rendering/vpProductPattern.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <optional>

namespace
{
using namespace generatePattern;

constexpr std::size_t LINE = 256; // longest line of a table, characters

//! \brief A table written line by line; it may exceed the memory.
class Table
{
public:
  Table(vpApp::OutputFolder &out, const std::string &name, const std::string &heading)
    : m_name((out.path() / name).string()), m_stream(out.file(name), std::ios::binary)
  {
    m_stream << heading << '\n';
  }
  void add(const char *line) { m_stream << line; }
  void close()
  {
    m_stream.close();
    if (!m_stream) {
      throw std::runtime_error(m_name + ": cannot be written");
    }
  }

private:
  std::string m_name;
  std::ofstream m_stream;
};

std::string encoded(const cv::Mat &frame, const std::string &format)
{
  std::vector<unsigned char> bytes;
  if (!cv::imencode("." + format, frame, bytes)) {
    throw std::runtime_error("OpenCV cannot write " + format + " images");
  }
  return {bytes.begin(), bytes.end()};
}

//! Video codecs require colour and even sizes.
cv::Mat forVideo(const cv::Mat &frame)
{
  cv::Mat even, colour;
  cv::copyMakeBorder(frame, even, 0, frame.rows % 2, 0, frame.cols % 2, cv::BORDER_REPLICATE);
  cv::cvtColor(even, colour, cv::COLOR_GRAY2BGR);
  return colour;
}

/*!
 * Write frames/, truth.csv, motion.csv and, if requested, video.mp4.
 * \return Number of lines of truth.csv without its heading.
 * \throw std::runtime_error naming a file that cannot be written; vpApp::Interrupted.
 */
std::size_t writeSequence(const Options &options, vpApp::OutputFolder &out)
{
  const Task &task = options.task;
  const vpProductPattern product(task.product);
  Table truth(out, "truth.csv", "frame,row,column,x,y,complete,defective");
  Table motion(out, "motion.csv", "frame,x,y,dx,dy");
  std::optional<vpApp::VideoFile> video;
  if (options.video) {
    const auto even = [](unsigned int size) { return static_cast<int>(size + size % 2); };
    video.emplace(out.file("video.mp4"), even(task.product.width), even(task.product.height), options.videoRate);
  }

  vpApp::Progress progress("rendering " + std::to_string(task.frames) + " frames", task.frames);
  std::size_t places = 0;
  vpImage<unsigned char> I;
  char line[LINE];
  Pair former = task.motion.placeAt(0.);
  for (unsigned int frame = 0; frame < task.frames; ++frame) {
    vpApp::throwIfInterrupted();
    const Pair place = task.motion.placeAt(frame);
    const Pair velocity = task.motion.velocityAt(frame);
    product.render(place[0], place[1], velocity[0], velocity[1], frame, I);
    const cv::Mat picture(static_cast<int>(I.getHeight()), static_cast<int>(I.getWidth()), CV_8UC1, I.bitmap);
    std::snprintf(line, sizeof line, "frames/%06u.", frame);
    out.write(line + options.format, encoded(picture, options.format));
    if (video) {
      video->write(forVideo(picture));
    }
    for (const vpPatternTruthCell &cell : product.cells(place[0], place[1])) {
      std::snprintf(line, sizeof line, "%u,%d,%d,%.6f,%.6f,%d,%d\n", frame, cell.row, cell.column, cell.x, cell.y,
                    cell.complete ? 1 : 0, cell.defective ? 1 : 0);
      truth.add(line);
      ++places;
    }
    std::snprintf(line, sizeof line, "%u,%.6f,%.6f,%.6f,%.6f\n", frame, place[0], place[1], place[0] - former[0],
                  place[1] - former[1]);
    motion.add(line);
    former = place;
    progress.add(1.);
  }
  truth.close();
  motion.close();
  if (video) {
    video->close();
  }
  return places;
}

void generate(const Options &options, const std::string &commandLine)
{
  vpApp::OutputFolder out("visp-generate-pattern", options.out);
  const std::size_t places = writeSequence(options, out);
  const nlohmann::ordered_json spec = jsonOf(options.task);
  out.write("config.json", spec.dump(2) + "\n");
  nlohmann::ordered_json summary = {{"version", VISP_DIRECT_VERSION},
                                    {"command", commandLine},
                                    {"frames", options.task.frames},
                                    {"places", places},
                                    {"spec", spec}};
  out.writeSummary(summary);
  vpApp::throwIfInterrupted();
  out.commit();
  std::cout << options.task.frames << " frames with " << places << " true places: " << options.out << std::endl;
}
} // namespace

int main(int argc, char **argv)
{
  return vpApp::runMain("visp-generate-pattern", [&]() -> int {
    Options options;
    if (readOptions(argc, argv, options)) {
      generate(options, vpApp::commandLine("visp-generate-pattern", argc, argv));
    }
    return vpApp::ExitOk;
  });
}
