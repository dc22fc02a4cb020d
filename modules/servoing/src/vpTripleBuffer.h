/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTripleBuffer.h
 * \brief Hands the newest value from one thread to another; neither waits.
 */
#ifndef vpTripleBuffer_h
#define vpTripleBuffer_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <array>
#include <atomic>
#include <cstddef>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Three values: one that the writer fills, one that the reader reads, and one in between, exchanged with either by
 * a single atomic operation. A value that is not read before the next one is lost.
 */
template <class Value> class vpTripleBuffer
{
public:
  //! The value that the writer fills.
  [[nodiscard]] Value &back() noexcept { return m_values[m_back]; }
  //! Hands back() over. Writer.
  void publish() noexcept { m_back = m_middle.exchange(m_back | fresh, std::memory_order_acq_rel) & ~fresh; }
  //! Takes the newest value as front(). Reader. \return False if there is none that was not read yet.
  [[nodiscard]] bool fetch() noexcept
  {
    if ((m_middle.load(std::memory_order_relaxed) & fresh) == 0) {
      return false;
    }
    m_front = m_middle.exchange(m_front, std::memory_order_acq_rel) & ~fresh;
    return true;
  }
  //! The value taken last. Reader.
  [[nodiscard]] const Value &front() const noexcept { return m_values[m_front]; }
  //! Calls \e change on all three; before there are threads.
  template <class Change> void forAll(Change change)
  {
    for (Value &value : m_values) {
      change(value);
    }
  }

private:
  static constexpr std::size_t fresh = 4;

  std::array<Value, 3> m_values{};
  std::size_t m_back = 0, m_front = 1;
  std::atomic<std::size_t> m_middle{2};
};

END_VISP_NAMESPACE
#endif
