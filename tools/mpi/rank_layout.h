// SPDX-License-Identifier: MIT
// Hosts, threads and cores of the ranks of an MPI run.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "mpi/mpi_session.h"
#include "tools/solve/solve_arguments.h"

namespace grove::detail {

// The vectors have one element per rank.
struct RankLayout {
  std::vector<std::string> hosts;
  std::vector<int> threads;
  std::vector<int> cores;             // number of cores that the rank may use
  std::vector<int> host_cores;        // number of all cores of the rank's host
  std::vector<std::string> unshared;  // why the rank has no shared memory; "" if it has
  std::size_t shared_bytes = 0;       // size of the shared memory on this rank's host
};

// Collective. If --threads is not given, sets it to this rank's share of its cores, which several
// ranks may use. If --memory-limit is not given, sets it to this rank's share of the memory of its
// host.
void divide_machine(const CLI::App& app, SolveArguments& arguments, const MpiSession& session);

// Collective. Gathers the layout of all ranks. `threads`, `memory`: threads and shared memory of
// this rank.
RankLayout gather_rank_layout(const MpiSession& session, std::int64_t threads,
                              const SharedMemory& memory);

// Returns the workers for the log, such as "2 each on 4 ranks, 2 hosts", followed by ", 912 MB
// shared" if ranks share memory.
std::string workers_text(const RankLayout& layout);
// Returns warnings about ranks with more threads than the cores that they may use, hosts with more
// threads than cores (the threads slow each other down), hosts with unused cores, and hosts without
// shared memory.
std::vector<std::string> warnings(const RankLayout& layout);

}  // namespace grove::detail
