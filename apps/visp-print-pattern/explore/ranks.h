/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file ranks.h
 * \brief The processes that mpirun started, or this one alone. Built from ranksMpi.cpp where MPI is, else from
 * ranksSingle.cpp.
 */
#ifndef printExplore_ranks_h
#define printExplore_ranks_h

#include <string>
#include <vector>

namespace printExplore
{
/*!
 * \brief MPI from the first line of a program to its last. MPI begins only if mpirun started the program, which the environment
 * tells; a plain start needs nothing of it. One thread, that of main(), may call these functions.
 */
class Ranks
{
public:
  //! \throw std::runtime_error if mpirun started several processes of a program that was built without MPI.
  Ranks();
  ~Ranks();
  Ranks(const Ranks &) = delete;
  Ranks &operator=(const Ranks &) = delete;

  [[nodiscard]] int rank() const { return m_rank; }   //!< Of this process, 0..size() - 1.
  [[nodiscard]] int size() const { return m_size; }   //!< Processes; 1 without mpirun.
  [[nodiscard]] int local() const { return m_local; } //!< Those of them on this machine, this one included.
  //! The text of rank 0, on all ranks.
  [[nodiscard]] std::string broadcast(const std::string &text) const;
  //! The texts of all ranks by rank, on rank 0; elsewhere nothing.
  [[nodiscard]] std::vector<std::string> gather(const std::string &text) const;
  //! End all ranks with a status; returns it if there is only one.
  [[nodiscard]] int endAll(int status) const;

private:
  int m_rank = 0;
  int m_size = 1;
  int m_local = 1;
};
} // namespace printExplore

#endif
