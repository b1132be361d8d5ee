// SPDX-License-Identifier: MIT
/// \file
/// Distributed solving, for programs that use MPI. <grove/grove.hpp> does not include this header,
/// because it needs <mpi.h>. The function is in the library of the CMake component `mpi`.
#pragma once

#include <mpi.h>

#include <optional>

#include "grove/export.hpp"
#include "grove/solve.hpp"

/// Functions for programs that use MPI.
namespace grove::mpi {

/// Finds a plan and proves a lower bound like grove::solve(), with all ranks of `communicator`.
///
/// Collective: all ranks call it, with the same instance and the same options except for threads,
/// limits, stop token and callbacks. On each rank Options::threads threads search, and the calling
/// thread exchanges messages with other ranks. The calling thread must be the one that initialised
/// MPI, with MPI_THREAD_FUNNELED or a higher level. Rank 0 returns the solution, the other ranks
/// std::nullopt. A limit that is reached on any rank, or a stop request there, ends the whole run.
/// Only rank 0 calls on_incumbent and on_progress. The communicator must not be used for other
/// communication during the call.
///
/// The defaults of threads and memory limit are for one process per host. Divide them by the number
/// of ranks on the host, unless each rank is bound to its own cores and has its own memory limit.
///
/// Throws on all ranks: Error if MPI is not initialised as described; InvalidArgument if the
/// arguments of any rank are invalid (with an empty field() on ranks whose own arguments are
/// valid); and InvalidArgument with field() "/instance" if the instances differ between ranks,
/// "/deterministic" if that option is set, or "/method" for a method that needs a single process.
///
/// Throws on one rank only: any later error, and on rank 0 Error if other ranks have not responded
/// within a second or two after a limit was reached. The caller must then call MPI_Abort.
GROVE_API std::optional<Solution> solve(const Instance& instance, const Options& options = {},
                                        MPI_Comm communicator = MPI_COMM_WORLD);

}  // namespace grove::mpi
