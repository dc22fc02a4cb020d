/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Chapter 4: keypoints of a real photograph in rendered views.
#include "keypointItems.h"

namespace thesisReport
{
std::vector<Part> keypointParts()
{
  const std::string chapter = "Chapter 4: 3D vision";
  return {{chapter, {{"table4.2", "SIFT and SURF: keypoints, matches and time"}}, 28., keypointTable},
          {chapter, {{"table4.3", "accuracy of the homography's decomposition with SURF"}}, 65., poseTable}};
}
} // namespace thesisReport
