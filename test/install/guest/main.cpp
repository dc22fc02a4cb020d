/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A law from a project that builds visp-direct as a part of itself.
#include <visp3/feedforward/vpServoLaw.h>

#include <iostream>

VISP_DIRECT_USING_NAMESPACE

int main()
{
  const auto law = vpServoLaw::create("ff-lookat");
  std::cout << "host: " << law->id() << std::endl;
  return law->id() == "ff-lookat" ? 0 : 1;
}
