/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-generate-pattern: images of a moving repetitive product, with the true positions of its cells.
#include "options.h"
#include "sequence.h"

#include "appMain.h"

#include <iostream>

namespace
{
using namespace generatePattern;

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
