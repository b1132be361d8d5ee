// SPDX-License-Identifier: MIT
// grove-fuzz-joint: tests that small puzzles are solved within the time limit and that the answers
// agree with the oracle. Exit codes: 0 no failure, 1 a wrong answer or more unsolved puzzles than
// allowed, 2 bad usage.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/solve.h"
#include "io/instance_file.h"
#include "io/map_file.h"
#include "model/check.h"
#include "tests/fuzz/random_puzzle.h"
#include "tests/oracle/joint_oracle.h"

namespace grove::detail::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

struct Arguments {
  int count = 500;
  std::uint64_t seed = 1;
  double seconds = 2;
  int threads = 1;
  std::size_t oracle_states = 2'000'000;
  int max_open = 0;
  std::string folder = {};
};

struct Tally {
  int solved = 0, infeasible = 0, open = 0, compared = 0, wrong = 0;
  std::vector<double> seconds = {};
  std::vector<double> cpu_seconds = {};
};

// Returns the error in an answer, or an empty string. Increments `tally.compared` if the answer is
// compared with the oracle's.
std::string complaint(const Instance& instance, const Solution& solution, std::size_t states,
                      Tally& tally) {
  if (solution.plan && !check(instance, solution).empty()) return "the plan is invalid";
  const oracle::Answer truth = oracle::solve_jointly(instance, states);
  if (truth.verdict == oracle::Verdict::kTooLarge) return "";
  ++tally.compared;
  const std::optional<Cost> best = truth.plan ? std::optional(truth.plan->cost) : std::nullopt;
  if (solution.status == Status::kInfeasible && best) return fmt::format("a plan costs {}", *best);
  if (solution.plan && !best) return "the oracle has no plan";
  if (best && solution.lower_bound > *best)
    return fmt::format("bound {}, but a plan costs {}", solution.lower_bound, *best);
  return "";
}

void solve_one(std::uint64_t seed, const Arguments& a, Tally& tally) {
  const TinyInstance puzzle = random_puzzle(seed);
  const Instance instance = puzzle.build();
  SolveOptions options;
  options.omega = Omega::from_double(0);
  options.threads = a.threads;
  const auto began = Clock::now();
  const std::clock_t cpu_began = std::clock();
  Limits limits;
  limits.set_deadline(began +
                      std::chrono::microseconds(static_cast<std::int64_t>(a.seconds * 1e6)));
  const Solution solution = solve(instance, options, limits, nullptr);
  tally.seconds.push_back(std::chrono::duration<double>(Clock::now() - began).count());
  tally.cpu_seconds.push_back(static_cast<double>(std::clock() - cpu_began) / CLOCKS_PER_SEC);
  const bool is_open =
      solution.status != Status::kOptimal && solution.status != Status::kInfeasible;
  ++(is_open                                  ? tally.open
     : solution.status == Status::kInfeasible ? tally.infeasible
                                              : tally.solved);
  if (is_open)
    fmt::print("seed {}: open, bound {}, plan {}\n{}\n", seed, solution.lower_bound,
               solution.plan ? fmt::format("{}", solution.plan->cost) : "-", puzzle.to_text());
  if (const std::string wrong = complaint(instance, solution, a.oracle_states, tally);
      !wrong.empty()) {
    ++tally.wrong;
    fmt::print("seed {}: WRONG: {}, bound {}: {}\n{}\n", seed, to_string(solution.status),
               solution.lower_bound, wrong, puzzle.to_text());
  }
}

std::string spread(std::vector<double> seconds) {
  std::ranges::sort(seconds);
  const auto at = [&](double part) {
    return seconds[static_cast<std::size_t>(part * static_cast<double>(seconds.size() - 1))];
  };
  return fmt::format("median {:.3f}, 95 % {:.3f}, worst {:.3f}", at(0.5), at(0.95), at(1));
}

int write(const Arguments& a) {
  for (int i = 0; i < a.count; ++i) {
    const std::string name = fmt::format("puzzle-{:03}", a.seed + static_cast<std::uint64_t>(i));
    const std::filesystem::path path = std::filesystem::path(a.folder) / name;
    const Instance instance = random_puzzle(a.seed + static_cast<std::uint64_t>(i)).build();
    write_map(path.string() + ".map", instance.grid());
    write_instance(path.string() + ".cts.json", instance, name + ".map");
  }
  fmt::print("wrote {} puzzles to {}\n", a.count, a.folder);
  return 0;
}

int run(const Arguments& a) {
  if (!a.folder.empty()) return write(a);
  Tally tally;
  for (int i = 0; i < a.count; ++i) solve_one(a.seed + static_cast<std::uint64_t>(i), a, tally);
  fmt::print(
      "{} puzzles: {} solved, {} infeasible, {} open; {} compared with the oracle, {} wrong\n",
      a.count, tally.solved, tally.infeasible, tally.open, tally.compared, tally.wrong);
  fmt::print("seconds: {}\nof processors: {}\n", spread(tally.seconds), spread(tally.cpu_seconds));
  return tally.wrong > 0 || tally.open > a.max_open ? 1 : 0;
}

}  // namespace
}  // namespace grove::detail::fuzz

int main(int argc, char** argv) {
  grove::detail::fuzz::Arguments a;
  CLI::App app("Compares the solver with the oracle on small puzzles.", "grove-fuzz-joint");
  app.add_option("--count", a.count)->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--seed", a.seed, "seed of the first puzzle; each next puzzle has the next seed")
      ->capture_default_str();
  app.add_option("--seconds", a.seconds, "time limit of each puzzle")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--threads", a.threads)->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--oracle-states", a.oracle_states, "limit on the joint states of the oracle")
      ->capture_default_str();
  app.add_option("--most-open", a.max_open, "number of puzzles that may stay unsolved")
      ->capture_default_str();
  app.add_option("--write", a.folder, "write the puzzles to this directory instead of solving them")
      ->check(CLI::ExistingDirectory);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return grove::detail::fuzz::run(a);
}
