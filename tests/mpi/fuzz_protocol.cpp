// SPDX-License-Identifier: MIT
// grove-fuzz-protocol: the distributed protocol in random orders of events, against exhaustive
// search.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "tests/mpi/try_schedule.h"

int main(int argc, char** argv) {
  CLI::App app("Solves random tiny instances by random ranks in random order of events.");
  std::uint64_t seed = 0;
  std::uint64_t count = 1000;
  app.add_option("--seed", seed, "The first seed")->capture_default_str();
  app.add_option("--count", count, "How many")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  grove::detail::testing::ScheduleTally tally;
  int failed = 0;
  for (std::uint64_t i = seed; i < seed + count; ++i)
    for (const std::string& what : grove::detail::testing::try_schedule(i, tally)) {
      fmt::print("seed {}: {}\n", i, what);
      ++failed;
    }
  fmt::print(
      "{} schedules ({} unfinished, {} struck, {} resumed, {} reopened, {} new beginnings), ",
      tally.tried, tally.unfinished, tally.struck, tally.resumed, tally.reopened, tally.restarts);
  fmt::print("{} nodes, {} batches, {} prices of ranks, {} facts, {} messages: {} false\n",
             tally.nodes, tally.batches, tally.prices, tally.facts, tally.messages, failed);
  return failed == 0 ? 0 : 1;
}
