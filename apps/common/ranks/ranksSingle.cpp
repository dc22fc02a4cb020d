/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// One process: built without MPI.
#include "ranks.h"

#include <cstdlib>
#include <stdexcept>

namespace vpApp
{
Ranks::Ranks()
{
  const char *size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (size != nullptr && std::atoi(size) > 1) {
    throw std::runtime_error(std::string("mpirun started ") + size +
                             " processes, but this program was built without MPI (Debian: libopenmpi-dev)");
  }
}

Ranks::~Ranks() = default;

std::string Ranks::broadcast(const std::string &text) const { return text; }

std::vector<std::string> Ranks::gather(const std::string &text) const { return {text}; }

int Ranks::endAll(int status) const { return status; }
} // namespace vpApp
