/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-avoid-obstacle: an arm goes past what the camera in its hand sees, from image to joints, and a report.
#include "options.h"
#include "story.h"

#include "appMain.h"

#include <iostream>

int main(int argc, char **argv)
{
  return vpApp::runMain("visp-avoid-obstacle", [&]() -> int {
    using namespace avoidObstacle;
    Options options;
    if (!readOptions(argc, argv, options)) {
      return vpApp::ExitOk;
    }
    const PhotoScene scene = loadPhotoScene(options);
    const Episode episode = play(scene, options);
    for (const std::string &sentence : storyOf(scene, options, episode)) {
      std::cout << sentence << std::endl;
    }
    return vpApp::ExitOk;
  });
}
