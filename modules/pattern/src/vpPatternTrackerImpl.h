/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// State and steps of vpPatternTracker.
#ifndef vpPatternTrackerImpl_h
#define vpPatternTrackerImpl_h

#include "vpCellAligner.h"
#include "vpLatticeFit.h"
#include "vpLightSlope.h"
#include "vpPatternSpot.h"
#include "vpPatternWorkers.h"
#include "vpRobustMean.h"

#include <visp3/pattern/vpPatternTracker.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

BEGIN_VISP_NAMESPACE

// Data stored for each cell from frame to frame: a ring in rows and columns, of fixed size.
class vpCellMemory
{
public:
  struct Slot {
    unsigned int generation = 0;        // of the memory when it was claimed
    int row = 0, column = 0, count = 0; // count: measurements in the deviation
    double offsetX = 0., offsetY = 0.;  // smoothed deviation from the lattice, px
    double x = 0., y = 0., varianceX = 0., varianceY = 0.;
    unsigned int frame = 0; // of x and y
    int cell = -1;          // index among the cells of that frame
  };

  explicit vpCellMemory(std::size_t capacity) : m_slots(capacity) {}

  //! Forget everything, and set the number of rows and columns stored at a time, within the capacity.
  void shape(int rows, int columns);
  //! Whether each of this many neighbouring rows and columns has a slot of its own.
  [[nodiscard]] bool holds(int rows, int columns) const
  {
    return rows <= 1 << m_rowBits && columns <= 1 << m_columnBits;
  }
  //! Forget everything, in constant time: old entries belong to another generation.
  void clear() { ++m_generation; }
  //! The cell if it is stored, or null.
  Slot *find(int row, int column);
  //! The cell; an older one in its slot is forgotten.
  Slot &claim(int row, int column);
  //! Initial deviation: its own, or the mean of its stored neighbours. True when it is its own.
  bool deviation(int row, int column, double &x, double &y);

private:
  Slot &at(int row, int column);
  std::vector<Slot> m_slots;
  unsigned int m_generation = 1;
  int m_rowBits = 0, m_columnBits = 0; // powers of two: finding a cell needs no division
};

class vpPatternTracker::Impl
{
public:
  Impl(unsigned int width, unsigned int height, const vpPatternTrackerSpec &spec);
  const vpPatternFrame &process(const vpImage<unsigned char> &image);
  void interrupt();
  void reset();

  vpPatternTrackerSpec m_spec;
  vpPatternFrame m_frame;

private:
  enum class Stage { Searching, Learning, Refining, Preparing, Locked };

  // Acquisition (vpPatternAcquisition.cpp)
  vpPatternReason detect(const vpImage<unsigned char> &image, vpLattice &lattice);
  vpPatternReason detectPolarity(const vpImage<unsigned char> &image, const vpPatternThresholdResult &level,
                                 bool bright, vpLattice &lattice);
  vpPatternReason adopt(const vpLattice &found);
  void acquire(const vpImage<unsigned char> &image);
  void cellsFromSpots();
  void learn(const vpImage<unsigned char> &image);

  // Known cells that are not at their expected positions (vpPatternAcquisition.cpp)
  bool relocate(const vpImage<unsigned char> &image);
  void lookForMissing(const vpImage<unsigned char> &image);
  bool findSpots(const vpImage<unsigned char> &image);
  const vpPatternSpot *spotAt(double x, double y, double reach) const;

  // Tracking (vpPatternAlignment.cpp)
  void follow(const vpImage<unsigned char> &image);
  bool alignAll(const vpImage<unsigned char> &image);
  void startAll(const vpImage<unsigned char> &image, bool expected = true);
  void setSlopes();
  bool mostKnownAreGone() const;
  bool deviateAsBefore();
  double allowance() const;
  void validate(const vpImage<unsigned char> &image);
  bool turnLattice(double limit);
  void turnOn();

  // Relearning the template while tracking (vpPatternRefresh.cpp)
  enum class Refresh { Collecting, Refining, Restoring, Preparing };
  void beginRefresh();
  void refresh(const vpImage<unsigned char> &image);
  bool collect(const vpImage<unsigned char> &image, int &taken);
  bool isGoodExample(std::size_t cell) const;
  bool exchange(const vpImage<unsigned char> &image);

  // Common part
  struct Range {
    int rowLow, rowHigh, columnLow, columnHigh;
  };
  // Calls strip(index, begin, end, thread) for each 64 cells of m_frame, in several threads. What is summed over the cells is summed
  // strip by strip, so that results do not depend on their number.
  static constexpr std::size_t cellsOfStrip = 64;
  template <class Strip> void forStrips(const Strip &strip)
  {
    const std::size_t n = m_frame.cells.size();
    m_workers.run(static_cast<int>((n + cellsOfStrip - 1) / cellsOfStrip), [&](int part, int thread) {
      const std::size_t k = static_cast<std::size_t>(part), begin = k * cellsOfStrip;
      strip(k, begin, std::min(n, begin + cellsOfStrip), thread);
    });
  }
  // Calls cell(index, thread) for each cell, likewise.
  template <class Cell> void forCells(const Cell &cell)
  {
    forStrips([&](std::size_t, std::size_t begin, std::size_t end, int thread) {
      for (std::size_t i = begin; i < end; ++i) {
        cell(i, thread);
      }
    });
  }
  // The same for a cell(index) that writes to the cell's slot in the memory.
  template <class Cell> void forSlots(const Cell &cell)
  {
    if (haveOwnSlots()) {
      forCells([&](std::size_t i, int) { cell(i); });
      return;
    }
    for (std::size_t i = 0; i < m_frame.cells.size(); ++i) {
      cell(i);
    }
  }
  Range inView(double halfWidth, double halfHeight) const;
  void listCells(double halfWidth, double halfHeight);
  double usualCells() const;
  void updateShare();
  void expectCells(bool deviations);
  bool haveOwnSlots() const;
  unsigned char useOf(bool measured, std::size_t cell) const;
  unsigned char leastUse() const;
  void updateLattice();
  void measureMotion();
  bool wasInLast(const vpCellMemory::Slot &slot) const { return slot.frame + 1 + m_gap == m_frame.index; }
  void remember();
  void updateDeviations();
  void anchor();
  void renumber(vpPatternReason reason);
  void lose(vpPatternReason reason, vpPatternStatus status);
  void publish();

  unsigned int m_width, m_height;
  std::size_t m_maxCells;
  Stage m_stage = Stage::Searching;
  vpRunLabels m_labels;
  vpLatticeFit m_fitter;
  vpLightSlope m_light; // for the edges
  vpTemplateLearner m_learner;
  vpTemplateBank m_bank, m_nextBank;
  vpPatternWorkers m_workers;
  std::vector<std::unique_ptr<vpCellAligner>> m_aligners; // one for each thread
  vpCellMemory m_memory;
  vpRobustMean m_meanX, m_meanY;

  vpLattice m_lattice; // its (0, 0) is the cell (m_row, m_column), near the middle of the view
  int m_row = 0, m_column = 0;
  unsigned int m_images = 0;   // number of images so far
  bool m_known = false;        // m_lattice is valid for an earlier image
  bool m_bright = true;        // polarity
  double m_vx = 0., m_vy = 0.; // px/frame
  unsigned int m_gap = 0;      // images without a lock just before this one
  bool m_interrupted = false;  // images are missing before the next
  int m_lostFrames = 0, m_learned = 0, m_refined = 0, m_rotate = 0;
  double m_share = 0.; // valid share of the cells in view, smoothed
  double m_noise = 0.; // variance of the residuals, smoothed
  Refresh m_refresh = Refresh::Collecting;
  int m_hurry = 0;                          // images for which the template is relearned at full speed
  int m_sinceFit = 0;                       // images since the template was first learned
  double m_fitNoise = 0.;                   // m_noise with a template just learned
  vpLattice m_turn{0., 0., 0., 0., 0., 0.}; // change of the vectors of the lattice from image to image
  bool m_turned = false;                    // the lattice has turned in this image
  int m_restless = 0;                       // images for which the turning may continue
  vpSlopes m_slopes{};                      // of the illumination
  double m_slopeWeight = 0.;
  double m_edgeVarianceX = 0.,
         m_edgeVarianceY = 0.;         // of centres from edges, from the spread of their motion; 0: unknown
  std::vector<vpCellFit> m_fits;       // of the cells of m_frame
  double m_shiftX = 0., m_shiftY = 0.; // common shift of all cells from their start
  std::vector<double> m_startX, m_startY, m_scratch, m_scratch2;
  // Of each cell, for medians and means over them: copies side by side, as the cells' own data are spread over the caches of
  // the processors.
  enum class Use : unsigned char { No, New, Known };
  std::vector<unsigned char> m_use;
  std::array<std::vector<double>, 5> m_columns;
  struct StripSums { // normal equations of the deviations
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  };
  std::vector<StripSums> m_stripSums;
  std::vector<unsigned char> m_ownStart; // the start of the cell includes its own deviation
};

END_VISP_NAMESPACE
#endif
