/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCellMemory.h"

#include <algorithm>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
int wrap(int i, int n) { return (i % n + n) % n; }
} // namespace

void vpCellMemory::shape(int rowsInView, int columnsInView)
{
  const int room = static_cast<int>(m_slots.size());
  m_columns = std::clamp(2 * columnsInView + 2, 1, room);
  m_rows = std::clamp(2 * rowsInView + 2, 1, room / m_columns);
  clear();
}

void vpCellMemory::clear() { std::fill(m_slots.begin(), m_slots.end(), Slot()); }

vpCellMemory::Slot &vpCellMemory::at(int row, int column)
{
  return m_slots[static_cast<std::size_t>(wrap(row, m_rows) * m_columns + wrap(column, m_columns))];
}

vpCellMemory::Slot *vpCellMemory::find(int row, int column)
{
  Slot &slot = at(row, column);
  return slot.count > 0 && slot.row == row && slot.column == column ? &slot : nullptr;
}

vpCellMemory::Slot &vpCellMemory::claim(int row, int column)
{
  Slot &slot = at(row, column);
  if (!slot.used || slot.row != row || slot.column != column) {
    slot = Slot();
    slot.used = true;
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
  for (const auto &step : {std::pair<int, int>{0, 1}, {0, -1}, {1, 0}, {-1, 0}}) {
    if (const Slot *other = find(row + step.first, column + step.second)) {
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
