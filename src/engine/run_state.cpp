// SPDX-License-Identifier: MIT
#include "engine/run_state.h"

#include <algorithm>
#include <string>

#include "io/input_error.h"
#include "model/fingerprint.h"
#include "model/limits.h"
#include "search/route_forest.h"
#include "search/sequence_forest.h"
#include "search/single_tree.h"

namespace grove::detail {
namespace {

bool same_sequences(const Tree& a, const Tree& b) {
  return std::ranges::equal(a.orders, b.orders, {}, &AgentSequencing::sequences,
                            &AgentSequencing::sequences);
}

std::unique_ptr<Forest> make_forest(const Problem& problem, AgentStopsCache& stops, NodePool& pool,
                                    const SolveOptions& options, const Limits& limits) {
  if (options.policy == Policy::kFixed && problem.instance.has_choices())
    return std::make_unique<RouteForest>(problem, pool, options.rtsp, limits);
  if (options.policy == Policy::kFixed)
    return std::make_unique<SequenceForest>(problem, pool, options.rtsp, limits);
  return std::make_unique<SingleTree>(
      problem, stops, pool, limits,
      make_agent_planner(options.low_level, problem.instance.world()));
}

}  // namespace

RunState::RunState(const Problem& problem, const SolveOptions& options, const Limits& limits,
                   RunObserver& observer, NodePool& pool, LiveNodes& nodes)
    : instance_(problem.instance),
      options_(options),
      limits_(limits),
      nodes_(nodes),
      stops_(problem.instance, problem.distances),
      forest_(make_forest(problem, stops_, pool, options, limits)),
      restored_trees_(problem, stops_, pool),
      run_events_(observer, [this] { return progress(); }),
      shared_bounds_(problem.instance, options.omega, limits, nodes, run_events_,
                     forest_->next_bound()),
      trees_(options, *forest_, nodes, shared_bounds_, run_events_) {}

void RunState::begin() {
  shared_bounds_.nodes_changed();
  if (options_.start) shared_bounds_.post(*options_.start, PlanSource::kStart);
  trees_.begin();
}

// Does not call nodes_changed(), because the nodes have not been pushed yet and the bound would be
// derived without them.
std::optional<std::vector<NodePtr>> RunState::restore(const CheckpointHeader& header) {
  resumed_ = true;
  before_.counters = header.counters;
  before_.seconds = header.seconds;
  shared_bounds_.resume_at(header.lower_bound);
  if (header.incumbent) shared_bounds_.post(*header.incumbent, PlanSource::kStart);
  if (options_.start) shared_bounds_.post(*options_.start, PlanSource::kStart);
  std::vector<NodePtr> roots;
  for (const TreeRecord& tree : header.trees) {
    const NodePtr same = forest_->next_root();
    if (!same && limits_.stop_requested()) return std::nullopt;
    roots.push_back(restored_trees_.add(tree, static_cast<std::uint32_t>(roots.size())));
    if (!same || !same_sequences(same->tree(), roots.back()->tree()))
      throw InputError(checkpoint_file(options_.checkpoints.directory).string(), "",
                       "its trees have another order than in this run; expected the same --rtsp");
    trees_.resume_with(roots.back());
  }
  return roots;
}

void RunState::restored() {
  shared_bounds_.nodes_changed();
  trees_.begin();
}

CheckpointHeader RunState::checkpoint_header(std::int64_t trees, Cost evicted_bound) {
  CheckpointHeader header;
  header.fingerprint = fingerprint(instance_);
  header.policy = options_.policy == Policy::kFixed ? Policy::kFixed : Policy::kFree;
  header.incumbent = shared_bounds_.global_bounds().incumbent();
  header.lower_bound = shared_bounds_.lower_bound();
  header.evicted_bound = evicted_bound;
  header.trees_instantiated = trees;
  header.trees = trees_.records(trees);
  header.counters["nodes_expanded"] = nodes_before() + nodes_.counts().expanded;
  header.seconds =
      before_.seconds + std::chrono::duration<double>(limits_.now() - started_).count();
  return header;
}

std::int64_t RunState::nodes_before() const {
  const auto found = before_.counters.find("nodes_expanded");
  return found == before_.counters.end() ? 0 : found->second;
}

Progress RunState::progress() const {
  const LiveNodes::Counts counts = nodes_.counts();
  return {counts.expanded, counts.open, trees_.count(), shared_bounds_.lower_bound(),
          shared_bounds_.global_bounds().incumbent_cost()};
}

Solution RunState::conclude() const {
  const GlobalBounds& global_bounds = shared_bounds_.global_bounds();
  Solution solution;
  solution.omega = options_.omega;
  solution.plan = global_bounds.incumbent();
  solution.lower_bound = global_bounds.lower_bound();
  solution.status = status_of(global_bounds.incumbent_cost(), solution.lower_bound, solution.omega);
  if (global_bounds.proven_infeasible()) {
    solution.status = Status::kInfeasible;
    solution.lower_bound = 0;
    if (shared_bounds_.has_no_joint_plan())
      solution.stats.texts["reason"] = CentralBounds::kNoJointPlan;
  }
  Counters counters;
  trees_.add_counts(counters);
  shared_bounds_.add_counts(counters);
  add(counters, solution.stats.counts);
  add_missing(solution.stats.counts);
  if (resumed_) {
    solution.stats.counts["nodes_expanded_before"] = nodes_before();
    solution.stats.measures["seconds_before"] = before_.seconds;
  }
  // A limit that was reached after the end of the search is not reported.
  if (!global_bounds.finished()) {
    const std::string stop = stop_text(limits_.reason());
    const bool evicted = nodes_.evicted_bound() < kInfiniteCost;
    solution.stats.texts["stopped_by"] = !stop.empty() ? stop
                                         : evicted     ? stop_text(StopReason::kMemory)
                                                       : "first tree exhausted";
  }
  return solution;
}

}  // namespace grove::detail
