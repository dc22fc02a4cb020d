/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMicroscopeCalibrationMessage.h"

#include <visp3/core/vpMath.h>

#include <cmath>
#include <cstdio>

BEGIN_VISP_NAMESPACE

namespace
{
template <class... Values> std::string message(const char *format, Values... values)
{
  char text[400];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string aboutKappa1(const vpMicroscopeCalibrationResult &result, const vpMicroscopeDecision &decision,
                        const vpMicroscopeCalibrationSpec &spec)
{
  switch (result.kappa1Status) {
  case vpKappa1Status::NotAsked:
    return "The distortion was not asked for.";
  case vpKappa1Status::Estimated:
    return message("The distortion kappa1 is %.4g +- %.2g px^-2 and moves the worst corner of the image by %.2g px.",
                    decision.kappa1, result.kappa1Sigma, result.kappa1Effect);
  case vpKappa1Status::Unobservable:
    break;
  }
  if (result.kappa1CornerSigma > spec.maxCornerSigma) {
    return message(
        "The distortion kappa1 is unobservable and taken as 0: the points cover so little of the image that "
        "its deviation of %.2g px^-2 is %.3g px at the farthest corner, more than %g px.",
        result.kappa1Sigma, result.kappa1CornerSigma, spec.maxCornerSigma);
  }
  if (decision.significance < spec.minSignificance) {
    return message("The distortion kappa1 is unobservable and taken as 0: the points say %.2g +- %.2g px^-2, %.1f "
                    "standard deviations from zero, less than %g.",
                    decision.kappa1, result.kappa1Sigma, decision.significance, spec.minSignificance);
  }
  return message("The distortion kappa1 is unobservable and taken as 0: in this field of view it would move the worst "
                  "corner by %.2g px, less than %g px.",
                  result.kappa1Effect, spec.minEffect);
}

std::string aboutTilt(const vpMicroscopeCalibrationResult &result, const vpMicroscopeCalibrationSpec &spec)
{
  if (!spec.estimateTilt) {
    return "";
  }
  const vpMicroscopeCalibration &c = result.calibration;
  const double tilt = std::hypot(c.tiltX, c.tiltY);
  const double sigma = std::hypot(result.sigma(vpMicroscopeTiltX), result.sigma(vpMicroscopeTiltY)) / std::sqrt(2.);
  return message(" By a tilt the scale changes by %.2g +- %.1g %% over the width of the image.", 100. * tilt * c.width,
                  100. * sigma * c.width);
}
} // namespace

std::string vpMicroscopeMessage(const vpMicroscopeCalibrationResult &result, const vpMicroscopeDecision &decision,
                                const vpMicroscopeCalibrationSpec &spec)
{
  const vpMicroscopeCalibration &c = result.calibration;
  std::string text = message("The scale is %.8g +- %.2g px/m (%.6g um a pixel)", c.scaleX,
                              result.sigma(vpMicroscopeScaleX), c.pixelSizeUm());
  if (c.scaleY != c.scaleX) {
    text += message(" along u and %.8g +- %.2g px/m along v", c.scaleY, result.sigma(vpMicroscopeScaleY));
  }
  text += ". " + aboutKappa1(result, decision, spec) + aboutTilt(result, spec);
  text += message(" The residuals are %.3g px (rms), %.3g times what the points' deviations say.", result.residualRms,
                   std::sqrt(result.varianceFactor));
  if (!result.converged) {
    text += " The refinement did not come to its end.";
  }
  if (!result.reliable) {
    text += " This is not reliable.";
  }
  if (decision.hiddenDistortion) {
    text += message(" There is a distortion (%.1f standard deviations from zero) that the points cannot tell for the "
                     "whole image: cover more of it.",
                     decision.significance);
  }
  if (result.looksTiltedTooFar) {
    text += message(
        " The product looks as if tilted by %.3g degrees: it is, or a pitch is wrong, or the cells are on another "
        "lattice than specified.",
        vpMath::deg(decision.looksTilted));
  }
  return text + " " + result.fit.message(result.varianceFactor);
}

END_VISP_NAMESPACE
