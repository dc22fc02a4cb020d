/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/pattern/vpPatternTrackerSpec.h>

#include <visp3/core/vpException.h>

BEGIN_VISP_NAMESPACE

namespace
{
void inRange(const char *field, double value, double low, double high)
{
  if (!(value >= low && value <= high)) {
    throw vpException(vpException::badValue, "vpPatternTrackerSpec: %s is %g, must be in [%g, %g]", field, value, low,
                      high);
  }
}
} // namespace

void vpPatternTrackerSpec::check() const
{
  inRange("minContrast", minContrast, 1., 255.);
  inRange("minPitch", minPitch, 4., 1000.);
  inRange("learningFrames", learningFrames, 2, 10000);
  inRange("phasesPerFrame", phasesPerFrame, 1, 16);
  inRange("refreshEvery", refreshEvery, 0, 1000000);
  inRange("maxCellSigma", maxCellSigma, 1e-6, 10.);
  inRange("maxLostFrames", maxLostFrames, 0, 1000000);
}

const char *vpToString(vpPatternMethod method)
{
  switch (method) {
  case vpPatternMethod::HalfMaximumEdges:
    return "HalfMaximumEdges";
  case vpPatternMethod::ThesisAlgorithm:
    return "ThesisAlgorithm";
  case vpPatternMethod::ThesisAlgorithmFixed:
    return "ThesisAlgorithmFixed";
  case vpPatternMethod::GaussNewton:
    break;
  }
  return "GaussNewton";
}

const char *vpToString(vpPatternDerivative derivative)
{
  switch (derivative) {
  case vpPatternDerivative::Roberts:
    return "Roberts";
  case vpPatternDerivative::Prewitt:
    return "Prewitt";
  case vpPatternDerivative::Sobel:
    return "Sobel";
  case vpPatternDerivative::Symmetric:
    break;
  }
  return "Symmetric";
}

END_VISP_NAMESPACE
