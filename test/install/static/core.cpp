/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Links direct_core.
#include <visp3/direct_core/vpSO3.h>

#include <iostream>

VISP_DIRECT_USING_NAMESPACE

int main()
{
  const Eigen::Vector3d angles(0., 0., 0.3);
  const double error = (vpSO3::log(vpSO3::exp(angles)) - angles).norm();
  std::cout << "core: error " << error << std::endl;
  return error < 1e-12 ? 0 : 1;
}
