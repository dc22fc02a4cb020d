/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file results.h
 * \brief What a run leaves in memory: numbers for the report, not images.
 */
#ifndef trackPattern_results_h
#define trackPattern_results_h

#include <visp3/pattern/vpPatternFrame.h>
#include <visp3/pattern/vpPlanarMicroscopeCalibration.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace trackPattern
{
constexpr double NOTHING = std::numeric_limits<double>::quiet_NaN();

//! \brief One image.
struct FrameRecord {
  unsigned int number = 0; //!< As the source has it.
  vpPatternStatus status = vpPatternStatus::Lost;
  vpPatternReason reason = vpPatternReason::None;
  const char *message = ""; //!< Static.
  unsigned int epoch = 0;
  int validCells = 0;
  int cells = 0;
  double dx = NOTHING, dy = NOTHING;           //!< Displacement, px; NaN: none.
  double sigmaDx = NOTHING, sigmaDy = NOTHING; //!< px.
  double dxUm = NOTHING, dyUm = NOTHING;       //!< Along the rows and across, um; NaN without calibration.
  double sigmaX = NOTHING, sigmaY = NOTHING;   //!< Median over the valid cells, px.
  double microseconds = 0.;                    //!< Of the tracker alone.
  double trueDx = NOTHING, trueDy = NOTHING;   //!< px; NaN: not known.
};

//! \brief Mean and deviation of errors.
struct Errors {
  long n = 0;
  double sum = 0., squares = 0.;
  double normalised = 0.; //!< Sum of squares of the errors in units of what the tracker says.

  void add(double error, double sigma)
  {
    ++n;
    sum += error;
    squares += error * error;
    normalised += std::isfinite(sigma) ? error * error / (sigma * sigma) : 0.;
  }
  [[nodiscard]] double mean() const { return n > 0 ? sum / static_cast<double>(n) : NOTHING; }
  [[nodiscard]] double sigma() const
  {
    return n > 0 ? std::sqrt(std::max(0., squares / static_cast<double>(n) - mean() * mean())) : NOTHING;
  }
  [[nodiscard]] double normalisedRms() const
  {
    return n > 0 && normalised > 0. ? std::sqrt(normalised / static_cast<double>(n)) : NOTHING;
  }
};

//! \brief Found against true.
struct TruthErrors {
  Errors x, y, dx, dy; //!< Of centres and of displacements, px.
  long far = 0;        //!< Centres more than 2 px off; they are not in the errors above.
  long slips = 0;      //!< Cells that got another name within an epoch.
  long noCell = 0;     //!< Valid cells where there is none.
};

//! \brief How far a cell lies off its place in the regular lattice.
struct CellDeviation {
  double x = 0., y = 0.; //!< px.
};

//! How a run ended.
enum class Ending {
  Complete,    //!< All images were seen.
  Interrupted, //!< By Ctrl-C, or a click: the results hold until then.
  Incomplete   //!< By a failure, see RunResults::failure: likewise.
};

//! \brief All of a run.
struct RunResults {
  Ending ending = Ending::Complete;
  std::string failure;              //!< The sentence of what failed; empty: nothing.
  std::size_t expected = 0;         //!< Number of images that there should be; 0: unknown.
  std::string input;                //!< What it is, for people.
  std::vector<std::string> remarks; //!< About reading it, in sentences.
  unsigned int width = 0, height = 0;
  std::vector<FrameRecord> frames;
  bool hasTruth = false;
  TruthErrors acquiring, tracking;                                        //!< Before and after the template is learned.
  std::map<std::tuple<unsigned int, int, int>, CellDeviation> deviations; //!< By epoch, row, column.
  vpPatternLattice lattice;                                               //!< Of the last image with one.
  std::string picture; //!< PNG of the overlay of a typical image; empty: none.
  std::string pictureCaption;
  std::optional<vpMicroscopeCalibration> calibration;      //!< In use.
  std::optional<vpMicroscopeCalibrationResult> calibrated; //!< Made by this run.
  std::size_t calibrationViews = 0;

  //! "complete", "interrupted" or "incomplete", for files.
  [[nodiscard]] const char *endingWord() const;
  [[nodiscard]] std::size_t count(vpPatternStatus status) const;
  //! Number of images with at least one valid cell.
  [[nodiscard]] std::size_t imagesWithCells() const;
};

//! vpQuantile() of the finite values; NaN when there is none.
[[nodiscard]] double quantile(std::vector<double> values, double p);
//! One number of every frame.
[[nodiscard]] std::vector<double> column(const RunResults &results, double FrameRecord::*member);
} // namespace trackPattern

#endif
