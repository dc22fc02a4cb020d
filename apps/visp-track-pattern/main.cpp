/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-track-pattern: cell centres and motion of a repetitive product, from images, a video or a camera.
#include "report.h"
#include "trackRun.h"

#include "appMain.h"
#include "outputFolder.h"
#include "plot.h"

#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace
{
using namespace trackPattern;

constexpr std::uintmax_t LARGEST_SHOWN_VIDEO = 12U << 20U; // bytes; a larger one would make the page slow

std::string videoFor(const Options &options, vpApp::OutputFolder &out)
{
  if (options.overlay != OverlayKind::Mp4) {
    return "";
  }
  const std::string file = out.file("overlay.mp4");
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(file, ignored);
  return !ignored && size < LARGEST_SHOWN_VIDEO ? vpApp::readFile(file) : "";
}

void writeResult(const Options &options, const RunResults &results, vpApp::OutputFolder &out,
                 const std::string &commandLine)
{
  out.write("report.html", reportPage(results, options, videoFor(options, out), commandLine));
  out.writeSummary(summaryOf(results, options, commandLine));
  out.commit();
  for (const std::string &line : findings(results)) {
    std::cout << line << "\n";
  }
  std::cout << "Report: " << (std::filesystem::path(options.out) / "report.html").string() << std::endl;
}

int track(const Options &options, const std::string &commandLine)
{
  vpApp::requireGnuplot();
  const Input input = openInput(options);
  vpApp::OutputFolder out("visp-track-pattern", options.out);
  RunResults results;
  try {
    trackAll(options, input, out, results);
    writeResult(options, results, out, commandLine);
  }
  catch (const std::exception &error) {
    if (results.frames.empty()) { // nothing to keep
      throw;
    }
    const std::string sentence = vpApp::sentenceOf(error);
    throw std::runtime_error(sentence + "; " + out.keepUnfinished(sentence));
  }
  if (results.ending == Ending::Incomplete) {
    throw std::runtime_error(results.failure + "; the report shows what was seen");
  }
  if (results.ending == Ending::Complete && results.imagesWithCells() == 0 && !results.calibrated) {
    throw std::runtime_error("no pattern was found; the report shows the images as they were read");
  }
  return results.ending == Ending::Interrupted && vpApp::interrupted() ? vpApp::ExitInterrupted : vpApp::ExitOk;
}
} // namespace

int main(int argc, char **argv)
{
  return vpApp::runMain("visp-track-pattern", [&]() -> int {
    Options options;
    if (!readOptions(argc, argv, options)) {
      return vpApp::ExitOk;
    }
    return track(options, vpApp::commandLine("visp-track-pattern", argc, argv));
  });
}
