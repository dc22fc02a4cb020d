/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file results.h
 * \brief Results of a run in memory: numbers for the report, not images.
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

//! \brief Results of one image.
struct FrameRecord {
  unsigned int number = 0; //!< Number from the source.
  vpPatternStatus status = vpPatternStatus::Lost;
  vpPatternReason reason = vpPatternReason::None;
  const char *message = ""; //!< Static string.
  unsigned int epoch = 0;
  int validCells = 0;
  int cells = 0;
  double dx = NOTHING, dy = NOTHING;           //!< Displacement, px; NaN: none.
  double sigmaDx = NOTHING, sigmaDy = NOTHING; //!< px.
  double dxUm = NOTHING, dyUm = NOTHING;       //!< Along the rows and across, um; NaN without calibration.
  double sigmaX = NOTHING, sigmaY = NOTHING;   //!< Median over the valid cells, px.
  double microseconds = 0.;                    //!< Time of the tracker only.
  double trueDx = NOTHING, trueDy = NOTHING;   //!< True displacement, px; NaN: unknown.
};

//! \brief Mean and standard deviation of errors.
struct Errors {
  long n = 0;
  double sum = 0., squares = 0.;
  double normalised = 0.; //!< Sum of squares of errors / reported sigma.

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

//! \brief Errors against the ground truth.
struct TruthErrors {
  Errors x, y, dx, dy; //!< Errors of centres and displacements, px.
  long far = 0;        //!< Centres more than 2 px off, not included in the errors above.
  long slips = 0;      //!< Cells renamed within an epoch.
  long noCell = 0;     //!< Valid cells without a true cell.
};

//! \brief Deviation of a cell from its position in the regular lattice.
struct CellDeviation {
  double x = 0., y = 0.; //!< px.
};

//! End of a run.
enum class Ending {
  Complete,    //!< All images were processed.
  Interrupted, //!< Interrupted by Ctrl-C or a click: results until then.
  Incomplete   //!< Ended by a failure, see RunResults::failure: results until then.
};

//! \brief Complete results of a run.
struct RunResults {
  Ending ending = Ending::Complete;
  std::string failure;              //!< Message of the failure; empty: none.
  std::size_t expected = 0;         //!< Expected number of images; 0: unknown.
  std::string input;                //!< Description of the input.
  std::vector<std::string> remarks; //!< Remarks on reading the input, in sentences.
  unsigned int width = 0, height = 0;
  std::vector<FrameRecord> frames;
  bool hasTruth = false;
  TruthErrors acquiring, tracking;                                        //!< Before and after the template is learned.
  std::map<std::tuple<unsigned int, int, int>, CellDeviation> deviations; //!< By epoch, row, column.
  vpPatternLattice lattice;                                               //!< Lattice of the last image with one.
  std::string picture;                                                    //!< PNG of the overlay of a typical image.
  std::optional<vpMicroscopeCalibration> calibration;                     //!< Calibration in use.
  std::optional<vpMicroscopeCalibrationResult> calibrated;                //!< Calibration made by this run.
  std::size_t calibrationViews = 0;

  //! "complete", "interrupted" or "incomplete", for files.
  [[nodiscard]] const char *endingWord() const;
  [[nodiscard]] std::size_t count(vpPatternStatus status) const;
  //! Number of images with at least one valid cell.
  [[nodiscard]] std::size_t imagesWithCells() const;
};

//! vpQuantile() of the finite values; NaN if there are none.
[[nodiscard]] double quantile(std::vector<double> values, double p);
//! One field of every frame.
[[nodiscard]] std::vector<double> column(const RunResults &results, double FrameRecord::*member);

//! Like printf, as a string.
[[nodiscard]] std::string text(const char *format, ...) __attribute__((format(printf, 1, 2)));
} // namespace trackPattern

#endif
