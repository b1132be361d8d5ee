// SPDX-License-Identifier: MIT
// Who takes part in a run of several processes.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "mpi/mpi_session.h"
#include "tools/solve/solve_arguments.h"

namespace grove::detail {

// What each rank says of itself, by rank.
struct RankLayout {
  std::vector<std::string> hosts;
  std::vector<int> threads;
  std::vector<int> cores;             // that it may use
  std::vector<int> host_cores;        // all cores of its host
  std::vector<std::string> unshared;  // why its host has no memory for all its ranks; empty: it has
  std::size_t shared_bytes = 0;       // that it has of such memory, on the host of this rank
};

// All ranks: gives this rank its share of what several have in common, where nothing was said about
// it: of the cores that they may use, and of the memory of a host.
void share_machine(const CLI::App& app, SolveArguments& arguments, const MpiSession& session);

// All ranks: what there is, this rank with so many threads and this part in a host's memory.
RankLayout gather_rank_layout(const MpiSession& session, std::int64_t threads,
                              const SharedMemory& memory);

// "2 each on 4 ranks, 2 hosts", and "912 MB shared" where there are any
std::string workers_text(const RankLayout& layout);
// More threads than cores slow each other down, and cores may be left idle without intent. Nor is
// it meant that each rank holds all for itself.
std::vector<std::string> warnings(const RankLayout& layout);

}  // namespace grove::detail
