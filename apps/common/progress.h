/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file progress.h
 * \brief Progress of a long job on stderr.
 */
#ifndef vpApp_progress_h
#define vpApp_progress_h

#include <chrono>
#include <iosfwd>
#include <mutex>
#include <string>

namespace vpApp
{
/*!
 * \brief A progress bar on a terminal; elsewhere (a file, a pipe, a build log) one plain line at every quarter.
 *
 * All functions may be called from any thread.
 */
class Progress
{
public:
  //! Display style.
  enum class Style {
    Bar,   //!< One line, rewritten.
    Lines, //!< A new line at 25, 50, 75 and 100 %.
    Silent //!< Nothing.
  };

  //! Bar when stderr is a terminal, else Lines.
  [[nodiscard]] static Style detect();

  /*!
   * \param title : Description of the job ("simulating 42 runs").
   * \param total : The sum of all add() when done, in any unit, > 0.
   * \param out : Where to print. \param style : How.
   */
  Progress(std::string title, double total, std::ostream &out, Style style);
  //! On stderr, in the suitable style.
  Progress(std::string title, double total);
  //! Ends the line of a bar.
  ~Progress();
  Progress(const Progress &) = delete;
  Progress &operator=(const Progress &) = delete;

  //! Add \e amount of finished work.
  void add(double amount);
  //! Fraction done, 0..1.
  [[nodiscard]] double share() const;

private:
  void show();

  std::string m_title;
  double m_total;
  double m_done = 0.;
  int m_shown = -1; // percent (Bar) or quarter (Lines) on display
  std::ostream &m_out;
  Style m_style;
  std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
  mutable std::mutex m_mutex;
};
} // namespace vpApp

#endif
