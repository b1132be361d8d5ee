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
struct Crew {
  std::vector<std::string> hosts;
  std::vector<int> threads;
  std::vector<int> cores;     // that it may use
  std::vector<int> machines;  // all cores of its host
};

// All ranks: gives this rank its share of what several have in common, where nothing was said about
// it: of the cores that they may use, and of the memory of a host.
void share_machine(const CLI::App& app, SolveArguments& arguments, const MpiSession& session);

// All ranks: what there is, this rank with so many threads.
Crew gather_crew(const MpiSession& session, std::int64_t threads);

// "2 each on 4 ranks, 2 hosts"
std::string workers_text(const Crew& crew);
// More threads than cores slow each other down, and cores may be left idle without intent.
std::vector<std::string> warnings(const Crew& crew);

}  // namespace grove::detail
