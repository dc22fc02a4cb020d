/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/printing/vpPrintTrigger.h>

#include "vpPrintingCheck.h"

#include <algorithm>

BEGIN_VISP_NAMESPACE

using namespace vpPrintingCheck;

namespace
{
constexpr double atRest = 1e-9; // px/frame

// Instant in [from, to] at which the position is reached; it is passed in between. Newton, kept inside the bracket.
double crossing(const vpMotionForecast &motion, double place, double from, double to)
{
  const bool rising = motion.at(to)[0] > place;
  double t = 0.5 * (from + to);
  for (int i = 0; i < 60; ++i) {
    const vpAxisState x = motion.at(t);
    ((x[0] > place) == rising ? to : from) = t;
    const double next = t - (x[0] - place) / x[1];
    const double before = t;
    t = next > from && next < to ? next : 0.5 * (from + to);
    if (std::fabs(t - before) < 1e-12) {
      break;
    }
  }
  return t;
}

void put(std::array<vpPrintShot, vpPrintTriggerOutput::capacity> &list, int &count, const vpPrintShot &shot)
{
  list[static_cast<std::size_t>(count)] = shot;
  ++count;
}
} // namespace

void vpPrintTriggerSpec::validate() const
{
  const char *const owner = "print trigger";
  place("nozzle", owner, nozzle);
  place("nozzleAcross", owner, nozzleAcross);
  bound("rowTolerance", owner, rowTolerance);
  notNegative("travelTime", owner, travelTime);
  notNegative("electronicsDelay", owner, electronicsDelay);
  positive("period", owner, period);
  notNegative("lead", owner, lead);
  require(horizon >= period + lead && usual(horizon), "horizon", owner, horizon, ">= period + lead and finite");
  notNegative("tolerance", owner, tolerance);
  notNegative("drift", owner, drift);
  positive("match", owner, match);
  require(capacity >= 16 && capacity <= 65536, "capacity", owner, capacity, "in [16, 65536]");
}

vpPrintTrigger::vpPrintTrigger(const vpPrintTriggerSpec &spec) : m_spec(spec)
{
  spec.validate();
  m_entries.resize(static_cast<std::size_t>(spec.capacity));
}

void vpPrintTrigger::reset() noexcept
{
  m_count = 0;
  m_hint = 0;
}

bool vpPrintTrigger::find(int row, int column, unsigned int epoch, double &along, double &across) const noexcept
{
  for (int i = 0; i < m_count; ++i) {
    const Entry &e = m_entries[static_cast<std::size_t>(i)];
    if (e.row == row && e.column == column && e.epoch == epoch) {
      along = e.along;
      across = e.across;
      return true;
    }
  }
  return false;
}

const char *vpPrintTriggerOutput::message() const noexcept
{
  if (status == vpPrintTriggerStatus::InputRefused) {
    return "InputRefused: a time or the forecast of the motion is implausible; nothing was fired.";
  }
  if (overflow) {
    return "Overflow: there was no capacity left for a cell, which may get no drop.";
  }
  if (missedCount > 0) {
    return "Missed: cells can no longer be hit, see missed.";
  }
  return status == vpPrintTriggerStatus::FrameRefused
             ? "FrameRefused: the time or the displacement of the capture is implausible; the cells were not used."
             : "Good: everything was used.";
}

vpPrintTriggerStatus vpPrintTrigger::judge(const vpPrintTriggerInput &input) const noexcept
{
  if (!vpIsPlausible(input.time) || !input.along.isPlausible() || !input.across.isPlausible() ||
      std::fabs(input.along.time - input.time) > vpMotionForecast::longest) {
    return vpPrintTriggerStatus::InputRefused;
  }
  const double age = input.time - input.captureTime;
  const bool good = age >= -m_spec.period && age <= vpMotionForecast::longest && vpIsPlausible(input.captureAlong) &&
                    vpIsPlausible(input.captureAcross) && (input.cellCount == 0 || input.cells != nullptr);
  return good || input.cellCount == 0 ? vpPrintTriggerStatus::Good : vpPrintTriggerStatus::FrameRefused;
}

const vpPrintTriggerOutput &vpPrintTrigger::step(const vpPrintTriggerInput &input) noexcept
{
  m_output.shotCount = m_output.missedCount = m_output.plannedCount = 0;
  m_output.overflow = false;
  m_output.status = judge(input);
  if (m_output.status == vpPrintTriggerStatus::InputRefused) {
    return m_output;
  }
  const bool seen = m_output.status == vpPrintTriggerStatus::Good;
  if (m_spec.method == vpPrintTriggerMethod::ThesisAlgorithm) {
    if (seen) {
      thesisStep(input);
    }
    return m_output;
  }
  if (seen) {
    see(input);
  }
  const double earliest = input.time + m_spec.travelTime + m_spec.electronicsDelay;
  const vpAxisState along = input.along.at(earliest);
  const double across = input.across.at(earliest)[0];
  for (int i = 0; i < m_count; ++i) {
    Entry &entry = m_entries[static_cast<std::size_t>(i)];
    if (entry.latch != Latch::Done) {
      schedule(input, along, across, entry);
    }
  }
  return m_output;
}

// Stores the cells of a frame.
void vpPrintTrigger::see(const vpPrintTriggerInput &input) noexcept
{
  const double movedAlong = input.captureAlong, movedAcross = input.captureAcross;
  for (std::size_t i = 0; i < input.cellCount; ++i) {
    const vpPatternCell &cell = input.cells[i];
    if (!vpIsUsableCell(cell)) {
      continue;
    }
    const bool alongX = m_spec.axis == vpPrintAxis::X;
    const double along = (alongX ? cell.x : cell.y) - movedAlong, across = (alongX ? cell.y : cell.x) - movedAcross;
    const double sigmaAlong = alongX ? cell.sigmaX : cell.sigmaY, sigmaAcross = alongX ? cell.sigmaY : cell.sigmaX;
    Entry *entry = known(cell.row, cell.column, input.epoch, along, across);
    if (entry == nullptr) {
      entry = room(m_spec.nozzle - movedAlong);
      if (entry == nullptr) {
        m_output.overflow = true;
        continue;
      }
      *entry = Entry();
      entry->row = cell.row;
      entry->column = cell.column;
      entry->epoch = input.epoch;
      entry->along = along;
      entry->across = across;
      entry->varianceAlong = sigmaAlong * sigmaAlong;
      entry->varianceAcross = sigmaAcross * sigmaAcross;
      entry->seen = input.captureTime;
      continue;
    }
    const double wandered = m_spec.drift * std::max(0., input.captureTime - entry->seen);
    const auto fuse = [wandered](double &value, double &variance, double z, double sigma) {
      variance += wandered;
      const double gain = variance / (variance + sigma * sigma);
      value += gain * (z - value);
      variance *= 1. - gain;
    };
    fuse(entry->along, entry->varianceAlong, along, sigmaAlong);
    fuse(entry->across, entry->varianceAcross, across, sigmaAcross);
    entry->seen = input.captureTime;
  }
}

// The entry of a cell: by identity, or by position if it is known from another epoch.
vpPrintTrigger::Entry *vpPrintTrigger::known(int row, int column, unsigned int epoch, double along,
                                             double across) noexcept
{
  Entry *same = nullptr;
  for (int k = 0; k < m_count; ++k) { // same order of cells as last time
    const int i = m_hint + k < m_count ? m_hint + k : m_hint + k - m_count;
    Entry &e = m_entries[static_cast<std::size_t>(i)];
    if (e.row == row && e.column == column && e.epoch == epoch) {
      m_hint = i + 1 < m_count ? i + 1 : 0;
      return &e;
    }
    if (e.epoch != epoch && std::fabs(e.along - along) < m_spec.match && std::fabs(e.across - across) < m_spec.match) {
      same = &e;
    }
  }
  if (same != nullptr) {
    same->row = row;
    same->column = column;
    same->epoch = epoch;
  }
  return same;
}

// A new entry; if none is free, that of the cell farthest from the nozzle and not approaching it.
vpPrintTrigger::Entry *vpPrintTrigger::room(double place) noexcept
{
  if (m_count < m_spec.capacity) {
    return &m_entries[static_cast<std::size_t>(m_count++)];
  }
  Entry *farthest = nullptr;
  for (Entry &e : m_entries) {
    if (e.latch != Latch::Armed &&
        (farthest == nullptr || std::fabs(e.along - place) > std::fabs(farthest->along - place))) {
      farthest = &e;
    }
  }
  return farthest;
}

// \e now, \e across: state at the landing of a drop fired now.
void vpPrintTrigger::schedule(const vpPrintTriggerInput &input, const vpAxisState &now, double across,
                              Entry &entry) noexcept
{
  const double delay = m_spec.travelTime + m_spec.electronicsDelay;
  const double earliest = input.time + delay;                // landing of a drop fired now
  const double ahead = entry.along + now[0] - m_spec.nozzle; // cell minus nozzle
  const double aside = entry.across + across - m_spec.nozzleAcross;
  const bool wanted = entry.column >= input.firstColumn && entry.column <= input.lastColumn;
  if (!wanted || !(std::fabs(aside) <= m_spec.rowTolerance)) {
    entry.latch = Latch::Waiting;
    return;
  }
  vpPrintShot shot;
  shot.row = entry.row;
  shot.column = entry.column;
  shot.epoch = entry.epoch;
  shot.sigma = std::sqrt(entry.varianceAlong + m_spec.drift * std::max(0., earliest - entry.seen));
  if (entry.latch == Latch::Armed && ahead * entry.side < 0.) { // passed since the last step
    shot.late = true;
    shot.fireTime = input.time;
    shot.landTime = earliest;
    shot.offset = -ahead;
    const bool hit = std::fabs(ahead) <= m_spec.tolerance;
    if (hit && m_output.shotCount < vpPrintTriggerOutput::capacity) {
      put(m_output.shots, m_output.shotCount, shot);
      entry.latch = Latch::Done;
    }
    else if (!hit && m_output.missedCount < vpPrintTriggerOutput::capacity) {
      put(m_output.missed, m_output.missedCount, shot);
      entry.latch = Latch::Done;
    }
    return;
  }
  if (ahead != 0.) {
    entry.side = ahead > 0. ? 1. : -1.;
  }
  if (ahead * now[1] > 0. || std::fabs(now[1]) < atRest) {
    return; // moves away, or not at all
  }
  entry.latch = Latch::Armed;
  const double place = m_spec.nozzle - entry.along;
  const double due = earliest + m_spec.period + m_spec.lead;
  const auto reached = [&](double t) { return (input.along.at(t)[0] - place) * now[1] > 0.; };
  if (ahead == 0. || reached(due)) {
    if (m_output.shotCount < vpPrintTriggerOutput::capacity) {
      shot.landTime = ahead == 0. ? earliest : crossing(input.along, place, earliest, due);
      shot.fireTime = std::max(input.time, shot.landTime - delay);
      put(m_output.shots, m_output.shotCount, shot);
      entry.latch = Latch::Done;
    }
    return;
  }
  const double last = input.time + m_spec.horizon + delay;
  if (m_output.plannedCount < vpPrintTriggerOutput::capacity && reached(last)) {
    shot.landTime = crossing(input.along, place, due, last);
    shot.fireTime = shot.landTime - delay;
    put(m_output.planned, m_output.plannedCount, shot);
  }
}

// Algorithm 7.5 with (7.21), (7.22), (7.24) as printed.
void vpPrintTrigger::thesisStep(const vpPrintTriggerInput &input) noexcept
{
  const double step = input.along.at(input.time)[1] * m_spec.period;
  for (std::size_t i = 0; i < input.cellCount && m_output.shotCount < vpPrintTriggerOutput::capacity; ++i) {
    const vpPatternCell &cell = input.cells[i];
    const bool alongX = m_spec.axis == vpPrintAxis::X;
    const double place = alongX ? cell.x : cell.y, aside = (alongX ? cell.y : cell.x) - m_spec.nozzleAcross;
    const double side = step < 0. ? -1. : 1.;
    const bool wanted = cell.column >= input.firstColumn && cell.column <= input.lastColumn;
    const bool crosses = wanted && side * place < side * m_spec.nozzle && side * (place + step) > side * m_spec.nozzle;
    if (!vpIsUsableCell(cell) || !crosses || !(std::fabs(aside) <= m_spec.rowTolerance)) {
      continue;
    }
    vpPrintShot shot;
    shot.row = cell.row;
    shot.column = cell.column;
    shot.epoch = input.epoch;
    const double untilCrossing = (m_spec.nozzle - (place + step)) / step * m_spec.period;
    const double fire = input.time + m_spec.period + untilCrossing - m_spec.travelTime - m_spec.electronicsDelay;
    shot.late = fire < input.time;
    shot.fireTime = std::max(fire, input.time);
    shot.landTime = shot.fireTime + m_spec.travelTime + m_spec.electronicsDelay;
    shot.sigma = alongX ? cell.sigmaX : cell.sigmaY;
    put(m_output.shots, m_output.shotCount, shot);
  }
}

END_VISP_NAMESPACE
