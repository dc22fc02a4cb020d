/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The processes of mpirun (Open MPI).
#include "ranks.h"

#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace vpApp
{
Ranks::Ranks()
{
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) {
    return;
  }
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &m_rank);
  MPI_Comm_size(MPI_COMM_WORLD, &m_size);
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, m_rank, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &m_local);
  MPI_Comm_free(&machine);
}

Ranks::~Ranks()
{
  int begun = 0, ended = 0;
  MPI_Initialized(&begun);
  MPI_Finalized(&ended);
  if (begun != 0 && ended == 0) {
    MPI_Finalize();
  }
}

std::string Ranks::broadcast(const std::string &text) const
{
  if (m_size == 1) {
    return text;
  }
  std::string all = text;
  unsigned long length = text.size();
  MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG, 0, MPI_COMM_WORLD);
  all.resize(length);
  MPI_Bcast(all.data(), static_cast<int>(length), MPI_CHAR, 0, MPI_COMM_WORLD);
  return all;
}

std::vector<std::string> Ranks::gather(const std::string &text) const
{
  if (m_size == 1) {
    return {text};
  }
  // MPI counts in int: 2 GB of text, some million designs.
  const int length = static_cast<int>(text.size());
  std::vector<int> lengths(static_cast<std::size_t>(m_size)), starts(lengths.size());
  MPI_Gather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  std::partial_sum(lengths.begin(), lengths.end() - 1, starts.begin() + 1);
  std::string all(static_cast<std::size_t>(m_rank == 0 ? starts.back() + lengths.back() : 0), ' ');
  MPI_Gatherv(text.data(), length, MPI_CHAR, all.data(), lengths.data(), starts.data(), MPI_CHAR, 0, MPI_COMM_WORLD);
  std::vector<std::string> texts;
  for (std::size_t i = 0; m_rank == 0 && i < lengths.size(); ++i) {
    texts.push_back(all.substr(static_cast<std::size_t>(starts[i]), static_cast<std::size_t>(lengths[i])));
  }
  return texts;
}

int Ranks::endAll(int status) const
{
  if (m_size > 1) {
    MPI_Abort(MPI_COMM_WORLD, status);
  }
  return status;
}
} // namespace vpApp
