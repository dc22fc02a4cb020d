/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Data stored for each cell from frame to frame: a ring in rows and columns, of fixed size.
#ifndef vpCellMemory_h
#define vpCellMemory_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <vector>

BEGIN_VISP_NAMESPACE

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

END_VISP_NAMESPACE
#endif
