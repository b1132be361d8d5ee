// SPDX-License-Identifier: MIT
#include "tests/fuzz/run_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <exception>

#include "tests/fuzz/claims.h"

namespace grove::detail::fuzz {
namespace {

using Clock = Limits::Clock;
using std::chrono::milliseconds;

// CBS need not terminate if there is no plan, so the time limit is then divided by this factor.
constexpr int kWithoutPlan = 10;
constexpr milliseconds kSoon{1};
constexpr milliseconds kAllowedOverrun{3000};
constexpr milliseconds kWorthRepeating{20};
constexpr std::size_t kScarceMemory = std::size_t{1} << 18;

struct Run {
  Solution solution;
  bool stopped = false;
  Clock::duration duration{};
  Clock::duration overrun{};
};

// Returns whether `limit` alone stops the run, whatever the solver does.
bool always_stops(ImposedLimit limit) {
  return limit == ImposedLimit::kExpired || limit == ImposedLimit::kInterrupt;
}

Run run(const Instance& instance, const FuzzCase& fuzz_case, const oracle::Answer& truth,
        milliseconds patience, const Solver& solver) {
  Limits limits;
  const std::atomic<bool> interrupt{true};
  const Clock::time_point begin = Clock::now();
  Clock::time_point deadline = begin + patience;
  if (fuzz_case.limit == ImposedLimit::kExpired) deadline = begin - milliseconds(1);
  if (fuzz_case.limit == ImposedLimit::kSoon) deadline = begin + kSoon;
  if (fuzz_case.limit == ImposedLimit::kMemory)
    limits.set_memory_limit(resident_bytes() + kScarceMemory);
  if (fuzz_case.limit == ImposedLimit::kInterrupt) limits.watch_interrupt(&interrupt);
  limits.set_deadline(deadline);

  const std::clock_t worked_before = std::clock();
  Run run{solver(instance, fuzz_case.options, limits, truth)};
  const Clock::time_point end = Clock::now();
  const auto worked = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(
      static_cast<double>(std::clock() - worked_before) / CLOCKS_PER_SEC));
  const auto& texts = run.solution.stats.texts;
  const auto stop = texts.find("stopped_by");
  const bool out_of_memory = (fuzz_case.options.node_memory != SolveOptions::kUnlimited ||
                              fuzz_case.limit == ImposedLimit::kMemory) &&
                             stop != texts.end() && stop->second == "memory limit";
  run.stopped =
      limits.reason() != StopReason::kNone || always_stops(fuzz_case.limit) || out_of_memory;
  run.duration = end - begin;
  // Counts only processor time beyond the deadline, because the operating system can suspend the
  // process.
  const Clock::time_point due = std::max(begin, deadline);
  run.overrun = std::min(end - due, worked - (due - begin));
  return run;
}

bool same_answer(const Solution& a, const Solution& b) {
  if (a.status != b.status || a.lower_bound != b.lower_bound) return false;
  if (a.plan.has_value() != b.plan.has_value()) return false;
  if (!a.plan) return true;
  return std::ranges::equal(a.plan->agents, b.plan->agents, {}, &AgentPlan::path, &AgentPlan::path);
}

// With choices and policy free, the searches of assignments divide the time.
bool divides_time(const Instance& instance, const SolveOptions& options) {
  return instance.has_choices() && options.policy != Policy::kFixed;
}

// With policy fixed, a run with choices reaches the requested tolerance like any other run.
void judge_effort(const Instance& instance, const FuzzCase& fuzz_case, const oracle::Answer& truth,
                  const Run& run, CaseResult& result) {
  const SolveOptions& options = fuzz_case.options;
  const Status status = run.solution.status;
  if (!instance.has_choices() || divides_time(instance, options) || run.stopped || !truth.plan ||
      options.omega.is_infinite())
    return;
  if (status == Status::kUnknown || status == Status::kFeasible)
    result.complaints.push_back(
        fmt::format("status {} although no limit was reached", to_string(status)));
}

void judge(const Instance& instance, const FuzzCase& fuzz_case, const oracle::Answer& truth,
           const Solver& solver, milliseconds patience, CaseResult& result) {
  if (!truth.plan) patience /= kWithoutPlan;
  FuzzCase again = fuzz_case;
  const Run first = run(instance, fuzz_case, truth, patience, solver);
  result.status = first.solution.status;
  result.stopped = first.stopped;
  result.complaints =
      false_claims(instance, truth, fuzz_case.options.omega, first.solution, first.stopped);
  judge_effort(instance, fuzz_case, truth, first, result);
  if (first.overrun > kAllowedOverrun)
    result.complaints.push_back(fmt::format("returned {} s after the deadline",
                                            std::chrono::duration<double>(first.overrun).count()));
  SolveOptions& options = again.options;
  const bool repeatable =
      options.deterministic || (options.threads == 1 && !divides_time(instance, options));
  if (first.stopped || first.duration > kWorthRepeating || !repeatable) return;
  if (options.deterministic) options.threads = options.threads % 4 + 1;
  const Run second = run(instance, again, truth, patience, solver);
  if (!second.stopped && !same_answer(first.solution, second.solution))
    result.complaints.push_back("the same run ends differently the second time");
}

}  // namespace

CaseResult run_case(const FuzzCase& fuzz_case, const Solver& solver,
                    std::chrono::milliseconds patience) {
  const Instance instance = fuzz_case.build();
  const oracle::Answer truth = oracle::solve_jointly(instance);
  CaseResult result;
  result.too_large = truth.verdict == oracle::Verdict::kTooLarge;
  if (result.too_large) return result;
  result.solvable = truth.plan.has_value();
  try {
    judge(instance, fuzz_case, truth, solver, patience, result);
  } catch (const std::exception& error) {
    result.complaints.push_back(fmt::format("threw: {}", error.what()));
  }
  return result;
}

}  // namespace grove::detail::fuzz
