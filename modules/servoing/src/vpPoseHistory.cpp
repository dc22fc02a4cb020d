/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPoseHistory.h"

#include "vpRigidMotion.h"

#include <algorithm>

BEGIN_VISP_NAMESPACE

void vpPoseHistory::add(double time, const vpRigidTransform &pose) noexcept
{
  const std::uint64_t index = m_end.load(std::memory_order_relaxed);
  Slot &slot = m_slots[index % m_slots.size()];
  slot.sequence.store(2 * index + 1, std::memory_order_relaxed);
  slot.numbers[0].store(time, std::memory_order_release);
  for (std::size_t i = 0; i < 9; ++i) {
    slot.numbers[1 + i].store(pose.R.data()[i], std::memory_order_release);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    slot.numbers[10 + i].store(pose.p.data()[i], std::memory_order_release);
  }
  slot.sequence.store(2 * index + 2, std::memory_order_release);
  m_end.store(index + 1, std::memory_order_release);
}

void vpPoseHistory::clear() noexcept
{
  m_first.store(m_end.load(std::memory_order_relaxed), std::memory_order_release);
}

bool vpPoseHistory::read(std::uint64_t index, Entry &entry) const noexcept
{
  const Slot &slot = m_slots[index % m_slots.size()];
  if (slot.sequence.load(std::memory_order_acquire) != 2 * index + 2) {
    return false; // overwritten
  }
  entry.time = slot.numbers[0].load(std::memory_order_acquire);
  for (std::size_t i = 0; i < 9; ++i) {
    entry.pose.R.data()[i] = slot.numbers[1 + i].load(std::memory_order_acquire);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    entry.pose.p.data()[i] = slot.numbers[10 + i].load(std::memory_order_acquire);
  }
  return slot.sequence.load(std::memory_order_relaxed) == 2 * index + 2;
}

bool vpPoseHistory::at(double time, vpRigidTransform &pose) const noexcept
{
  const std::uint64_t end = m_end.load(std::memory_order_acquire);
  std::uint64_t first = m_first.load(std::memory_order_acquire);
  first = std::max(first, end > m_slots.size() ? end - m_slots.size() : 0);
  if (end < first + 2) {
    Entry only;
    const bool isKnown = end > first && read(first, only) && only.time == time;
    pose = isKnown ? only.pose : pose;
    return isKnown;
  }
  // The first entry after the time, but not the very first one, and the last one for a time beyond it.
  std::uint64_t low = first + 1, high = end - 1;
  Entry from, to;
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    // An entry that was overwritten meanwhile is an old one.
    read(middle, to) &&to.time >= time ? high = middle : low = middle + 1;
  }
  if (!read(low - 1, from) || !read(low, to) || !(from.time < to.time)) {
    return false;
  }
  const double share = (time - from.time) / (to.time - from.time);
  if (!(share >= 0. && share <= 3.)) {
    return false;
  }
  pose = from.pose * vpRigidMotion::exp(vpRigidMotion::log(from.pose.inverse() * to.pose).scaled(share));
  return true;
}

END_VISP_NAMESPACE
