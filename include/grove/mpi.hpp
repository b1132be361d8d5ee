// SPDX-License-Identifier: MIT
/// \file
/// Distributed solving, for programs that use MPI. Not part of <grove/grove.hpp>, because it needs
/// <mpi.h>; it is in the library of the component `mpi`.
#pragma once

#include <mpi.h>

#include <optional>

#include "grove/export.hpp"
#include "grove/solve.hpp"

/// For programs that use MPI.
namespace grove::mpi {

/// Finds a plan and proves a lower bound, like grove::solve(), with all processes of
/// `communicator`.
///
/// Collective: all ranks of the communicator call it, with the same instance and the same options
/// except for threads and memory limit. On each rank Options::threads threads search, and the
/// calling thread exchanges the messages. It must be the thread that initialised MPI, with
/// MPI_THREAD_FUNNELED or more. Rank 0 returns the solution, the others std::nullopt. The time
/// limit, the stop token and the functions of rank 0 apply; the memory limit of each rank applies
/// to that rank and ends the run. No other communication may take place in the communicator during
/// the call. The defaults of threads and memory are for one process per host. Divide them by the
/// number of ranks on the host, unless each rank is bound to its own cores and has its own memory
/// limit.
///
/// Throws on all ranks what grove::solve() throws, if the arguments of any rank are invalid; and
/// InvalidArgument with field() "/instance" if the ranks have different instances, "/deterministic"
/// if that is set, "/method" for methods that need one process. A later error occurs on one rank
/// only: then call MPI_Abort. Rank 0 throws Error if other ranks do not respond a second or two
/// after a limit was reached; then call MPI_Abort, too.
GROVE_API std::optional<Solution> solve(const Instance& instance, const Options& options = {},
                                        MPI_Comm communicator = MPI_COMM_WORLD);

}  // namespace grove::mpi
