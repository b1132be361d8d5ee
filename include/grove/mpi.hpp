// SPDX-License-Identifier: MIT
/// \file
/// One solve by many processes, for programs that speak MPI. Not part of <grove/grove.hpp>: it
/// needs <mpi.h>, and is in the library of the component `mpi`.
#pragma once

#include <mpi.h>

#include <optional>

#include "grove/export.hpp"
#include "grove/solve.hpp"

/// For programs that speak MPI.
namespace grove::mpi {

/// Finds a plan, and proves how good it is, as grove::solve(), by all processes of `communicator`.
///
/// Collective: all its ranks call it, each with the same instance and options but for its own
/// threads and memory limit. Each searches with its threads beside the calling one, which speaks:
/// the one that initialised MPI, with MPI_THREAD_FUNNELED or more. Rank 0 returns the solution, the
/// others nothing. The time limit, the stop token and the functions of rank 0 count; any rank's
/// memory limit ends the run. Nothing else may go on in the communicator meanwhile.
/// The defaults of threads and memory are those of one process on a host: divide them by the ranks
/// there, unless each is bound to cores of its own and has been granted memory of its own.
///
/// Throws on all ranks what grove::solve() throws, if any of them is given what it refuses; and
/// InvalidArgument, "/instance", if they are not given the same one, "/deterministic" if that is
/// set, and "/method" for methods that are for one process. What goes wrong later goes wrong on one
/// rank alone: then call MPI_Abort. So does rank 0, with an Error, when other ranks say nothing any
/// more, a second or two after a limit has struck.
GROVE_API std::optional<Solution> solve(const Instance& instance, const Options& options = {},
                                        MPI_Comm communicator = MPI_COMM_WORLD);

}  // namespace grove::mpi
