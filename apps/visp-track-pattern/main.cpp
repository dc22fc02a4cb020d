/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-track-pattern: cell centres and motion of a repetitive product, from images, a video or a camera.
#include "findings.h"
#include "trackRun.h"

#include "appMain.h"
#include "outputFolder.h"
#include "report.h"

#include <iostream>
#include <stdexcept>

namespace
{
using namespace trackPattern;

void writeResult(const Options &options, const RunResults &results, vpApp::OutputFolder &out,
                 const std::string &commandLine)
{
  out.write("picture.png", results.picture);
  out.write("deviations.csv", deviationsCsv(results));
  const std::string made = vpApp::finishWithReport(out, summaryOf(results, options, commandLine), true);
  for (const std::string &line : findings(results)) {
    std::cout << line << "\n";
  }
  std::cout << made << std::endl;
}

int track(const Options &options, const std::string &commandLine)
{
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
