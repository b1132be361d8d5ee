// SPDX-License-Identifier: MIT
// From an instance to an answer: what is evident is said without a search; else workers share one.
#include "grove/engine/solve.h"

#include <new>
#include <string>

#include "grove/engine/central_ledger.h"
#include "grove/engine/local_nodes.h"
#include "grove/engine/multicore.h"
#include "grove/engine/run_observer.h"
#include "grove/engine/shared_search.h"
#include "grove/engine/worker.h"
#include "grove/search/feasibility.h"
#include "grove/search/gate.h"
#include "stop_text.h"

namespace grove {
namespace {

void solve_alone(Worker& worker, const SharedSearch& shared) {
  while (!shared.over()) worker.turn();
}

Solution search(const Problem& problem, const SolveOptions& options, const Limits& limits,
                RunObserver& observer) {
  const int lanes = options.deterministic ? kDeterministicLanes : options.threads;
  LocalNodes nodes;
  CentralLedger ledger(problem, options, limits, observer, nodes.pool, nodes);
  SharedSearch shared(options, limits, nodes, ledger);
  std::vector<std::unique_ptr<Worker>> workers;
  try {
    ledger.begin();
    for (int number = 0; number < lanes; ++number)
      workers.push_back(
          std::make_unique<Worker>(problem, options, limits, shared, ledger.stops(), number));
    if (options.deterministic)
      solve_in_rounds(workers, shared, options.threads);
    else if (lanes > 1)
      solve_together(workers, shared, limits);
    else
      solve_alone(*workers.front(), shared);
  } catch (const std::bad_alloc&) {
    limits.memory_exhausted();
  }
  Stats stats;
  for (const auto& worker : workers) worker->add_counts(stats);
  workers.clear();  // their memory may be needed for the answer
  ledger.end();
  Solution solution = ledger.conclude();
  shared.add_counts(solution.stats);
  solution.stats.counts.merge(stats.counts);
  solution.stats.measures["node_bytes"] = nodes.pool.mean_bytes();
  return solution;
}

Solution without_search(const SolveOptions& options, Status status, const std::string& key,
                        const std::string& text) {
  Solution solution;
  solution.status = status;
  solution.omega = options.omega;
  solution.stats.texts[key] = text;
  return solution;
}

// A limit struck before there was a bound: all there may be is the plan that was given.
Solution stopped_before_search(const Instance& instance, const SolveOptions& options,
                               const Limits& limits, RunObserver& observer) {
  Solution solution =
      without_search(options, Status::kUnknown, "stopped_by", stop_text(limits.reason()));
  if (!options.start) return solution;
  Gate gate(instance, options.omega);
  gate.post(*options.start);
  solution.plan = gate.incumbent();
  solution.status = status_of(solution.plan->cost, solution.lower_bound, options.omega);
  observer.on_incumbent(*solution.plan, PlanSource::kStart,
                        Progress{0, 0, 0, 0, solution.plan->cost});
  return solution;
}

}  // namespace

std::optional<Solution> answer_without_search(const Problem& problem, const SolveOptions& options,
                                              const Limits& limits, RunObserver& observer) {
  if (!problem.distances.complete())
    return stopped_before_search(problem.instance, options, limits, observer);
  const auto reason = evident_infeasibility(problem);
  if (!reason) return std::nullopt;
  observer.on_infeasible(*reason);
  return without_search(options, Status::kInfeasible, "reason", *reason);
}

Solution solve(const Instance& instance, const SolveOptions& options, const Limits& limits,
               RunObserver* observer) {
  RunObserver silent;
  RunObserver& watcher = observer ? *observer : silent;
  try {
    const Problem problem(instance, limits);
    if (auto answer = answer_without_search(problem, options, limits, watcher))
      return std::move(*answer);
    return search(problem, options, limits, watcher);
  } catch (const std::bad_alloc&) {  // before the search: nothing is known yet
    limits.memory_exhausted();
    return stopped_before_search(instance, options, limits, watcher);
  }
}

}  // namespace grove
