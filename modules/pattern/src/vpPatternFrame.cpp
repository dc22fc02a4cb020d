/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/direct_core/vpField.h>
#include <visp3/pattern/vpPatternFrame.h>
#include <visp3/pattern/vpPatternTrackerSpec.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
void inRange(const char *field, double value, double low, double high)
{
  vpCheckField(field, "the pattern tracker", value, "", {low, high});
}
} // namespace

double vpPatternLattice::columnPitch() const { return std::hypot(columnPitchX, columnPitchY); }
double vpPatternLattice::rowPitch() const { return std::hypot(rowPitchX, rowPitchY); }
double vpPatternLattice::angle() const { return std::atan2(columnPitchY, columnPitchX); }

const char *vpPatternFrame::message() const
{
  switch (reason) {
  case vpPatternReason::WrongSize:
    return "Lost: the image has not the size that the tracker was made for.";
  case vpPatternReason::NoContrast:
    return "No lock: the image has no contrast, or not two grey levels that separate cells from their surroundings.";
  case vpPatternReason::NoCells:
    return "No lock: there are no spots of equal size.";
  case vpPatternReason::TooMuchNoise:
    return "No lock: there are more spots than a pattern can have.";
  case vpPatternReason::NoLattice:
    return "No lock: there are not two periods of a rectangular lattice, with one cell a period, each way in view.";
  case vpPatternReason::SingleRow:
    return "No lock: the cells are on a single row, two periods each way are needed.";
  case vpPatternReason::TurnedTooFar:
    return "No lock: the rows are turned by more than 30 degrees against the image's.";
  case vpPatternReason::CellTooSmall:
    return "No lock: the cells or their pitch are too small.";
  case vpPatternReason::Learning:
    return "Acquiring: the lattice is known, the template is being learned.";
  case vpPatternReason::CellsMissing:
    return "Degraded: less than half of the cells in view fit the pattern.";
  case vpPatternReason::AmbiguousMotion:
    return "Degraded: the motion is near or above half a pitch, the identities restarted.";
  case vpPatternReason::IdentitySlip:
    return "Degraded: the cells do not deviate from the lattice as before, the identities restarted.";
  case vpPatternReason::Restarted:
    return "Degraded: found again after a long loss, the identities restarted.";
  case vpPatternReason::ImagesMissing:
    return "Degraded: images are missing before this one, the identities restarted.";
  case vpPatternReason::NoMatch:
    return "Lost: the image does not show the pattern where it can be.";
  case vpPatternReason::None:
    break;
  }
  return status == vpPatternStatus::Tracking ? "Tracking." : "Acquiring: no image yet.";
}

const char *vpToString(vpPatternStatus status)
{
  switch (status) {
  case vpPatternStatus::Tracking:
    return "Tracking";
  case vpPatternStatus::Degraded:
    return "Degraded";
  case vpPatternStatus::Lost:
    return "Lost";
  case vpPatternStatus::Acquiring:
    break;
  }
  return "Acquiring";
}

void vpPatternTrackerSpec::check() const
{
  inRange("minContrast", minContrast, 1., 255.);
  inRange("minPitch", minPitch, 4., 1000.);
  inRange("learningFrames", learningFrames, 2, 10000);
  inRange("phasesPerFrame", phasesPerFrame, 1, 16);
  inRange("refreshEvery", refreshEvery, 0, 1000000);
  inRange("maxCellSigma", maxCellSigma, 1e-6, 10.);
  inRange("maxLostFrames", maxLostFrames, 0, 1000000);
  inRange("threads", threads, 1, 64);
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
