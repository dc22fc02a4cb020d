/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Gains of the drives of an arm, see vpArmDrives.
#ifndef vpArmDriveGains_h
#define vpArmDriveGains_h

#include <visp3/simulation/vpArmDrives.h>

BEGIN_VISP_NAMESPACE

constexpr double vpDriveEstimatorBandwidth = 300.; // rad/s, of estimated velocities

//! Joint control with the gains of the spec, else of the model, else derived. \throw vpException: a link without mass.
vpJointPositionControlSpec vpDriveControlOf(const vpArmModel &model, const vpArmDriveSpec &spec);

END_VISP_NAMESPACE
#endif
