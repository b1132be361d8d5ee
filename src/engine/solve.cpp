// SPDX-License-Identifier: MIT
// Solves an instance by presolve if that suffices, otherwise by workers that share one search.
#include "engine/solve.h"

#include <new>
#include <string>

#include "assignment/infeasible_choices.h"
#include "engine/checkpoint.h"
#include "engine/components.h"
#include "engine/live_nodes.h"
#include "engine/local_checkpoints.h"
#include "engine/multicore.h"
#include "engine/run_observer.h"
#include "engine/run_state.h"
#include "engine/worker.h"
#include "model/choices.h"
#include "model/limits.h"
#include "search/feasibility.h"
#include "search/global_bounds.h"
#include "search/proof_log.h"

namespace grove::detail {
namespace {

// Instantiates the first tree or restores the checkpoint. Returns false if a limit was reached and
// the run must not search.
bool begin(const Problem& problem, const SolveOptions& options, RunState& run, LocalNodes& nodes) {
  if (options.resume) return restore(*options.resume, problem.instance, run, nodes);
  run.begin();
  return true;
}

// The workers of a run.
class Workers {
 public:
  explicit Workers(Components& components)
      : options_(components.context().options), components_(components) {
    const int count = options_.deterministic ? kDeterministicWorkers : options_.threads;
    for (int number = 0; number < count; ++number)
      workers_.push_back(std::make_unique<Worker>(components, number));
  }

  void run(const BetweenItems& between_turns) {
    if (options_.deterministic)
      run_deterministic(workers_, components_, options_.threads, between_turns);
    else if (workers_.size() > 1)
      run_parallel(workers_, components_, components_.context().limits, between_turns);
    else
      run_single_threaded(*workers_.front(), components_, between_turns);
  }

  // Thread-safe.
  void add_counts(Counters& counters) const {
    for (const auto& worker : workers_) worker->add_counts(counters);
  }

 private:
  const SolveOptions& options_;
  Components& components_;
  std::vector<std::unique_ptr<Worker>> workers_;
};

Solution search(const Problem& problem, const SolveOptions& options, const Limits& limits,
                RunObserver& observer) {
  LocalNodes nodes;
  RunState run(problem, options, limits, observer, nodes.pool, nodes);
  LocalCheckpoints checkpoints(options, limits, run, nodes);
  Counters counters;  // of workers that have been destroyed
  std::optional<Components> components;
  std::optional<Workers> workers;
  run.run_events().set_statistics_source([&] {
    Counters so_far = counters;
    if (workers) workers->add_counts(so_far);
    if (components) components->add_counts(so_far);
    run.shared_bounds().add_counts(so_far);
    const auto before_search = [] {
      return MemoryUse{.process = static_cast<std::int64_t>(resident_bytes())};
    };
    return RunStatistics{{so_far.named(), components ? components->memory_use() : before_search()},
                         {}};
  });
  bool begun = false;
  try {
    begun = begin(problem, options, run, nodes);
    if (begun) {
      components.emplace(problem, options, limits, run.stops(), nodes, run.shared_bounds(),
                         run.trees(), run.run_events());
      workers.emplace(*components);
      workers->run([&] { checkpoints.write_if_due(); });
    }
  } catch (const std::bad_alloc&) {
    limits.memory_exhausted();
  }
  if (workers) workers->add_counts(counters);
  workers.reset();  // their memory may be needed for the solution
  if (components && options.proof != nullptr) components->log_proof(*options.proof);
  if (begun) checkpoints.write_last();
  run.end();
  Solution solution = run.conclude();
  if (components) components->add_counts(counters);
  add(counters, solution.stats.counts);
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

// Returns the solution of a run that reached a limit before the search: the start plan, and the
// bound and plan of a resumed run, if any.
Solution stopped_before_search(const Instance& instance, const SolveOptions& options,
                               const Limits& limits, RunObserver& observer) {
  Solution solution =
      without_search(options, Status::kUnknown, "stopped_by", stop_text(limits.reason()));
  GlobalBounds global_bounds(instance, options.omega);
  if (options.resume) {
    const CheckpointHeader& before = options.resume->header();
    global_bounds.update(before.lower_bound, before.lower_bound);
    if (before.incumbent) global_bounds.post(*before.incumbent);
  }
  if (options.start) global_bounds.post(*options.start);
  solution.lower_bound = global_bounds.lower_bound();
  solution.plan = global_bounds.incumbent();
  if (!solution.plan) return solution;
  solution.status = status_of(solution.plan->cost, solution.lower_bound, options.omega);
  observer.on_incumbent(*solution.plan, PlanSource::kStart,
                        Progress{0, 0, 0, solution.lower_bound, solution.plan->cost});
  return solution;
}

// Only policy kFixed supports choices.
void require_supported_choices(const Instance& instance, const SolveOptions& options) {
  if (options.policy != Policy::kFixed)
    require_no_choices(instance, "this engine does not support");
}

std::optional<Solution> presolve_with_choices(const Problem& problem, const SolveOptions& options,
                                              const Limits& limits, RunObserver& observer) {
  const Instance& instance = problem.instance;
  if (!problem.distances.complete())
    return stopped_before_search(instance, options, limits, observer);
  const auto reason = instance.has_choices() ? infeasible_choices(instance, problem.distances)
                                             : presolve_infeasibility(problem);
  if (!reason) return std::nullopt;
  observer.on_infeasible(*reason);
  return without_search(options, Status::kInfeasible, "reason", *reason);
}

}  // namespace

std::optional<Solution> presolve(const Problem& problem, const SolveOptions& options,
                                 const Limits& limits, RunObserver& observer) {
  require_no_choices(problem.instance, "this engine does not support");
  return presolve_with_choices(problem, options, limits, observer);
}

Solution solve(const Problem& problem, const SolveOptions& options, const Limits& limits,
               RunObserver* observer) {
  RunObserver silent;
  RunObserver& watcher = observer ? *observer : silent;
  require_supported_choices(problem.instance, options);
  try {
    if (auto answer = presolve_with_choices(problem, options, limits, watcher))
      return std::move(*answer);
    return search(problem, options, limits, watcher);
  } catch (const std::bad_alloc&) {  // thrown before the search
    limits.memory_exhausted();
    return stopped_before_search(problem.instance, options, limits, watcher);
  }
}

Solution solve(const Instance& instance, const SolveOptions& options, const Limits& limits,
               RunObserver* observer) {
  try {
    const Problem problem(instance, limits, options.threads);
    return solve(problem, options, limits, observer);
  } catch (const std::bad_alloc&) {
    RunObserver silent;
    limits.memory_exhausted();
    return stopped_before_search(instance, options, limits, observer ? *observer : silent);
  }
}

}  // namespace grove::detail
