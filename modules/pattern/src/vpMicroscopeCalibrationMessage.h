/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The messages of a planar calibration.
#ifndef vpMicroscopeCalibrationMessage_h
#define vpMicroscopeCalibrationMessage_h

#include <visp3/pattern/vpPlanarMicroscopeCalibration.h>

BEGIN_VISP_NAMESPACE

// Internal results and decisions.
struct vpMicroscopeDecision {
  double kappa1 = 0.;            // estimate, px^-2, whether it is used or not
  double significance = 0.;      // of kappa1, standard deviations
  bool hiddenDistortion = false; // distortion is present, but the points cover too little of the image to estimate it
  double looksTilted = 0.;       // from foreshortening, rad
};

[[nodiscard]] std::string vpMicroscopeMessage(const vpMicroscopeCalibrationResult &result,
                                              const vpMicroscopeDecision &decision,
                                              const vpMicroscopeCalibrationSpec &spec);

END_VISP_NAMESPACE
#endif
