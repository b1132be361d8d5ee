// SPDX-License-Identifier: MIT
// The low level, whatever a tree leaves open.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "grove/baselines/baseline_search.h"
#include "grove/planning/agent_stops_store.h"
#include "grove/planning/free_low_level_search.h"
#include "grove/planning/low_level_search.h"
#include "grove/planning/optimal_paths.h"
#include "grove/search/node.h"

namespace grove {

// Plans one agent under an AgentOrder: through its goals where the order is fixed, else choosing
// the order, by the low level that the problem names. Workspace of one thread: reuse it, do not
// share it.
class PathPlanner {
 public:
  // Both must outlive this; `stops` may be shared with others of the same thread.
  PathPlanner(const Problem& problem, AgentStopsStore& stops);

  // As FreeLowLevelSearch::find; a fixed order and the low levels of other methods do not heed
  // `most_labels`, and the latter neither `others`.
  using Outcome = FreeLowLevelSearch::Outcome;
  Outcome find(AgentIndex agent, const AgentOrder& order, std::span<const Constraint> constraints,
               const ConflictAvoidanceTable* others, Time cutoff, const Limits& limits, Path& path,
               std::int64_t most_labels = FreeLowLevelSearch::kUnlimited);

  // As OptimalPathsBuilder::build.
  OptimalPathsBuilder::Outcome optimal_paths(AgentIndex agent, const AgentOrder& order,
                                             std::span<const Constraint> constraints, Time cost,
                                             std::size_t most_nodes, const Limits& limits,
                                             OptimalPaths& paths);

  // A sequence that `path`, which must realize one that the order and the constraints leave, visits
  // its stops in.
  Sequence sequence(AgentIndex agent, const AgentOrder& order,
                    std::span<const Constraint> constraints, const Path& path);

  // A split of the class that the order and the constraints leave, on the next stop of `path`,
  // which must obey both; none if they leave no choice.
  std::optional<Split> sequence_split(AgentIndex agent, const AgentOrder& order,
                                      std::span<const Constraint> constraints, const Path& path);

  // Calls of find(), and labels expanded by them, so far.
  std::int64_t calls() const { return calls_; }
  std::int64_t expanded() const {
    return fixed_.expanded() + free_.expanded() + (baseline_ ? baseline_->expanded() : 0);
  }
  // Nodes of sets of optimal paths, so far.
  std::int64_t optimal_nodes() const { return optimal_.nodes(); }
  // Calls and labels, in units of about one label.
  std::int64_t work() const { return expanded() + kWorkPerCall * calls_; }

 private:
  using Constraints = std::span<const Constraint>;

  static constexpr std::int64_t kWorkPerCall = 16;  // what a call costs beside its labels

  FreeGoals& free_goals(AgentIndex agent, const AgentOrder& order, Constraints constraints);
  FreeGoals& free_goals(AgentIndex agent, const SequenceClass& work);
  Constraints on_path(Constraints constraints);
  Outcome find_fixed(const GoalSequence& goals, std::span<const Constraint> constraints,
                     const ConflictAvoidanceTable* others, Time cutoff, const Limits& limits,
                     Path& path);
  Outcome find_as_others_do(AgentIndex agent, Constraints constraints, Time cutoff,
                            const Limits& limits, Path& path);

  std::int64_t calls_ = 0;
  LowLevelSearch fixed_;
  FreeLowLevelSearch free_;
  std::unique_ptr<BaselineSearch> baseline_;  // in place of free_; null: none
  OptimalPathsBuilder optimal_;
  AgentStopsStore& stops_;
  std::vector<std::vector<std::unique_ptr<FreeGoals>>>
      free_goals_;  // by AgentIndex: of the classes asked for last, the last of all in front
  std::vector<Constraint> on_path_;
};

}  // namespace grove
