/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCellMemory.h"

#include <algorithm>

BEGIN_VISP_NAMESPACE

namespace
{
// Smallest number of bits that count to n.
int bitsFor(int n)
{
  int bits = 0;
  while ((1 << bits) < n && bits < 20) {
    ++bits;
  }
  return bits;
}
} // namespace

void vpCellMemory::shape(int rows, int columns)
{
  m_rowBits = bitsFor(rows);
  m_columnBits = bitsFor(columns);
  while ((std::size_t(1) << (m_rowBits + m_columnBits)) > m_slots.size()) {
    --(m_rowBits > m_columnBits ? m_rowBits : m_columnBits);
  }
  clear();
}

vpCellMemory::Slot &vpCellMemory::at(int row, int column)
{
  const unsigned int r = static_cast<unsigned int>(row) & ((1u << m_rowBits) - 1);
  const unsigned int c = static_cast<unsigned int>(column) & ((1u << m_columnBits) - 1);
  return m_slots[(static_cast<std::size_t>(r) << m_columnBits) + c];
}

vpCellMemory::Slot *vpCellMemory::find(int row, int column)
{
  Slot &slot = at(row, column);
  const bool same = slot.generation == m_generation && slot.row == row && slot.column == column;
  return same && slot.count > 0 ? &slot : nullptr;
}

vpCellMemory::Slot &vpCellMemory::claim(int row, int column)
{
  Slot &slot = at(row, column);
  if (slot.generation != m_generation || slot.row != row || slot.column != column) {
    slot = Slot();
    slot.generation = m_generation;
    slot.row = row;
    slot.column = column;
  }
  return slot;
}

bool vpCellMemory::deviation(int row, int column, double &x, double &y)
{
  if (const Slot *own = find(row, column)) {
    x = own->offsetX;
    y = own->offsetY;
    return true;
  }
  int n = 0;
  x = y = 0.;
  for (const Slot *other :
       {find(row, column + 1), find(row, column - 1), find(row + 1, column), find(row - 1, column)}) {
    if (other != nullptr) {
      x += other->offsetX;
      y += other->offsetY;
      ++n;
    }
  }
  x /= std::max(1, n);
  y /= std::max(1, n);
  return false;
}

END_VISP_NAMESPACE
