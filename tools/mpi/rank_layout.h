// SPDX-License-Identifier: MIT
// Ranks, hosts, threads and cores of a run with several processes.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "mpi/mpi_session.h"
#include "tools/solve/solve_arguments.h"

namespace grove::detail {

// Data of all ranks, by rank.
struct RankLayout {
  std::vector<std::string> hosts;
  std::vector<int> threads;
  std::vector<int> cores;             // cores that the rank may use
  std::vector<int> host_cores;        // all cores of its host
  std::vector<std::string> unshared;  // why its host has no shared memory; "" if it has
  std::size_t shared_bytes = 0;       // size of the shared memory on the host of this rank
};

// Collective. If --threads or --memory-limit is not given, sets it to this rank's share of the
// cores that several ranks may use, and of the memory of its host.
void divide_machine(const CLI::App& app, SolveArguments& arguments, const MpiSession& session);

// Collective. Gathers the layout; this rank has `threads` threads and the shared memory `memory`.
RankLayout gather_rank_layout(const MpiSession& session, std::int64_t threads,
                              const SharedMemory& memory);

// Returns "2 each on 4 ranks, 2 hosts", with ", 912 MB shared" if memory is shared.
std::string workers_text(const RankLayout& layout);
// Returns warnings about hosts with more threads than cores, which slow each other down, with
// unused cores, and without shared memory.
std::vector<std::string> warnings(const RankLayout& layout);

}  // namespace grove::detail
