/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPoseHistory.h
 * \brief The last poses with their times, written by one thread and read by others; nobody waits.
 */
#ifndef vpPoseHistory_h
#define vpPoseHistory_h

#include <visp3/manipulator/vpArmTypes.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Ring of poses. Each slot has a sequence number, odd while it is written (a seqlock); the data are atomics, stored
 * with release and loaded with acquire order, so that a reader that sees a part of a new entry sees its number, too.
 */
class vpPoseHistory
{
public:
  //! \param capacity : Number of poses kept, >= 4.
  explicit vpPoseHistory(std::size_t capacity) : m_slots(capacity) {}

  //! Adds a pose; times increase. Writer.
  void add(double time, const vpRigidTransform &pose) noexcept;
  //! Forgets all poses. Writer.
  void clear() noexcept;
  /*!
   * Pose at a time, with a constant twist between two entries, and for up to two of the last steps beyond the last one.
   * \return False if not known.
   */
  [[nodiscard]] bool at(double time, vpRigidTransform &pose) const noexcept;

private:
  struct Entry {
    double time = 0.;
    vpRigidTransform pose;
  };
  struct Slot {
    std::atomic<std::uint64_t> sequence{0};
    std::array<std::atomic<double>, 13> numbers{};
  };
  [[nodiscard]] bool read(std::uint64_t index, Entry &entry) const noexcept;

  std::vector<Slot> m_slots;
  std::atomic<std::uint64_t> m_first{0}, m_end{0}; // indices of entries since the beginning
};

END_VISP_NAMESPACE
#endif
