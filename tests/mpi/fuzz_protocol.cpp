// SPDX-License-Identifier: MIT
// grove-fuzz-protocol: runs the distributed protocol with events in random order and compares the
// answers with the optimum.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "tests/mpi/try_schedule.h"

int main(int argc, char** argv) {
  CLI::App app("Solves random tiny instances with random ranks and events in random order.");
  std::uint64_t seed = 0;
  std::uint64_t count = 1000;
  app.add_option("--seed", seed, "first seed")->capture_default_str();
  app.add_option("--count", count, "number of schedules")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  grove::detail::testing::ScheduleTally tally;
  int failed = 0;
  for (std::uint64_t i = seed; i < seed + count; ++i)
    for (const std::string& what : grove::detail::testing::try_schedule(i, tally)) {
      fmt::print("seed {}: {}\n", i, what);
      ++failed;
    }
  fmt::print("{} schedules ({} unfinished, {} at a limit, {} resumed, {} reopened, {} restarts), ",
             tally.tried, tally.unfinished, tally.limit_reached, tally.resumed, tally.reopened,
             tally.restarts);
  fmt::print("{} nodes, {} batches, {} remote pricings, {} bounds, {} messages: {} false\n",
             tally.nodes, tally.batches, tally.remote_pricings, tally.learned_bounds,
             tally.messages, failed);
  return failed == 0 ? 0 : 1;
}
