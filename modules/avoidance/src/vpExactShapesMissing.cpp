/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpExactQuery.h"
#include "vpMissingLibrary.h"

BEGIN_VISP_NAMESPACE

struct vpExactBody {
};
struct vpExactQuery::Objects {
};

vpExactShapes::vpExactShapes(const vpArmModel &) { vpMissingLibrary("vpExactShapes", "FCL"); }
vpExactShapes::~vpExactShapes() = default;
bool vpExactShapes::has(int) const noexcept { return false; }
double vpExactShapes::thickness(int) const noexcept { return 0.; }
bool vpExactShapes::isOf(const vpArmModel &) const noexcept { return false; }

vpExactQuery::vpExactQuery() = default;
vpExactQuery::~vpExactQuery() = default;
vpClearance vpExactQuery::clearance(const vpCollisionScene &, const vpCollisionData &, const vpExactPair &, double,
                                    bool)
{
  vpClearance touching;
  touching.distance = 0.;
  return touching;
}

END_VISP_NAMESPACE
