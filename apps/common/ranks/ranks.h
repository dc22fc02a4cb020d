/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file ranks.h
 * \brief The processes started by mpirun, or a single process. Built from ranksMpi.cpp with MPI, else from
 * ranksSingle.cpp.
 */
#ifndef vpApp_ranks_h
#define vpApp_ranks_h

#include <functional>
#include <string>
#include <vector>

namespace vpApp
{
/*!
 * \brief MPI for the lifetime of a program. MPI is initialised only if the environment shows that mpirun started the
 * program; a plain start does not need MPI. Only the thread of main() may call these functions.
 */
class Ranks
{
public:
  //! \throw std::runtime_error if mpirun started several processes of a program built without MPI.
  Ranks();
  ~Ranks();
  Ranks(const Ranks &) = delete;
  Ranks &operator=(const Ranks &) = delete;

  [[nodiscard]] int rank() const { return m_rank; }          //!< Rank of this process, 0..size() - 1.
  [[nodiscard]] int size() const { return m_size; }          //!< Number of processes; 1 without mpirun.
  [[nodiscard]] bool isFirst() const { return m_rank == 0; } //!< The rank that talks to the user and writes.
  //! \e jobs, or this rank's share of the cores of its machine if \e jobs is 0.
  [[nodiscard]] unsigned int threads(unsigned int jobs) const;
  //! The text of rank 0, on all ranks.
  [[nodiscard]] std::string broadcast(const std::string &text) const;
  //! The texts of all ranks in rank order, on rank 0; empty elsewhere.
  [[nodiscard]] std::vector<std::string> gather(const std::string &text) const;
  //! End all ranks with a status; returns the status if there is only one rank.
  [[nodiscard]] int endAll(int status) const;

private:
  int m_rank = 0;
  int m_size = 1;
  int m_local = 1;
};

//! runMain() with all ranks: an error of one ends all with its status.
[[nodiscard]] int runRanks(const std::string &program, const std::function<void(const Ranks &)> &body);
//! Read the command line on rank 0, then on the others: help and mistakes are printed once. \return That of \e read.
[[nodiscard]] bool readOnFirst(const Ranks &ranks, const std::function<bool()> &read);
} // namespace vpApp

#endif
