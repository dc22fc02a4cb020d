/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Links most of planar_target: with OpenCV, dlib and BLAS. The argument is the data folder.
#include <visp3/planar_target/vpPlanarTargetDatabase.h>

#include <iostream>
#include <string>

VISP_DIRECT_USING_NAMESPACE

int main(int, char **argv)
{
  const vpCameraParameters camera(600., 600., 320., 240.);
  const auto targets = vpPlanarTargetDatabase::fromFolder(std::string(argv[1]) + "/target", camera);
  std::cout << "targets: " << targets.size() << std::endl;
  return targets.size() == 3 ? 0 : 1;
}
