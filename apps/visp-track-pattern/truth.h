/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file truth.h
 * \brief Ground truth of the cells, if known, and results compared with it.
 */
#ifndef trackPattern_truth_h
#define trackPattern_truth_h

#include "results.h"

#include <visp3/rendering/vpProductPattern.h>

#include <filesystem>
#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace trackPattern
{
//! \brief Ground truth of one frame.
struct FrameTruth {
  std::vector<vpPatternTruthCell> cells; //!< All cells in view.
  double x = 0.;                         //!< Displacement of the product, px.
  double y = 0.;                         //!< Displacement of the product, px.
};

//! \brief Ground truth written by visp-generate-pattern: truth.csv and motion.csv.
class TruthFiles
{
public:
  //! True if \e folder holds both files.
  [[nodiscard]] static bool areIn(const std::filesystem::path &folder);
  //! \throw std::runtime_error naming file, line and error.
  explicit TruthFiles(const std::filesystem::path &folder);
  //! Ground truth of a frame by its number; nullopt if missing in the files.
  [[nodiscard]] std::optional<FrameTruth> at(unsigned int frame) const;

private:
  std::unordered_map<unsigned int, FrameTruth> m_frames;
};

/*!
 * \brief Compares frame by frame; stores which true cell each name belongs to.
 */
class Comparison
{
public:
  //! \param left, top : Corner of the tracked region, px. Sets the true displacement in \e record.
  void add(const vpPatternFrame &frame, const FrameTruth &truth, double left, double top, FrameRecord &record,
           RunResults &results);
  //! A frame without truth interrupts the displacements.
  void skip() { m_before.reset(); }

private:
  std::optional<FrameTruth> m_before;
  std::map<std::tuple<unsigned int, int, int>, std::pair<int, int>> m_names;
};
} // namespace trackPattern

#endif
