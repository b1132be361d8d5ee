// SPDX-License-Identifier: MIT
// Choosing a conflict of a node and splitting the node on it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "grove/conflicts/conflict.h"
#include "grove/model/limits.h"
#include "grove/planning/conflict_avoidance_table.h"
#include "grove/planning/fewest_conflicts.h"
#include "grove/search/memory.h"
#include "grove/search/node.h"
#include "grove/search/path_planner.h"
#include "grove/search/techniques.h"

namespace grove {

// Looks at a node through the eyes of some of its agents, the *scope*: only their conflicts count,
// and only their paths change. With all agents in scope that is CBS; with a few it is CBS on what
// the node demands of them. The essay on how the conflict is chosen is at the head of brancher.cpp.
// Workspace of one thread.
class Brancher {
 public:
  enum class Outcome : std::uint8_t {
    kBranched,
    kConflictFree,  // of the scope, as they are at the node or after going round each other for
                    // free: see path()
    kStopped,       // a limit struck: nothing is known
  };

  // All must outlive this; `planner` and `memory` may be shared with others of the same thread.
  // `seed` decides between conflicts of equal time.
  Brancher(const Problem& problem, Techniques techniques, std::uint64_t seed, PathPlanner& planner,
           Memory& memory);

  // Turns to a node and to the agents in scope, which are in ascending order.
  void enter(const NodePtr& node, std::span<const AgentIndex> scope);
  // Lets the node go.
  void leave() { node_ = nullptr; }

  // Of the node entered, and after branch() of what became of it.
  bool conflict_free() const { return conflicts_.empty(); }
  std::span<const Conflict> conflicts() const { return conflicts_; }
  const Path& path(AgentIndex agent) const { return paths_[agent]; }
  // Of an agent in scope at the node entered.
  Situations::Id situation(AgentIndex agent);
  const AgentOrder& order(AgentIndex agent) const { return *node_->tree().orders[agent]; }
  // In canonical order.
  std::span<const Constraint> constraints(AgentIndex agent) const { return constraints_[agent]; }

  // Makes the children, appended to `children`: every plan that obeys the node's constraints and
  // costs less than `cutoff` obeys those of one of them. At most two; a child that surely holds no
  // such plan is none. `last_resorts` are further splits, valid at the node: one is made where no
  // conflict offers any that raises the cost of a side, and its two agents are in conflict.
  Outcome branch(Cost cutoff, std::span<const Split> last_resorts, const Limits& limits,
                 std::vector<NodePtr>& children);

  // So far: steps of paths looked through for conflicts, nodes of sets of paths for those of
  // fewest.
  std::int64_t steps() const { return steps_; }
  std::int64_t optimal_nodes() const { return fewest_conflicts_.nodes(); }

 private:
  // What one side of a split leads to.
  struct Side {
    bool open = false;  // else it holds no plan cheaper than the cutoff
    Cost increase = 0;
    int conflicts = 0;               // more than before
    std::vector<AgentIndex> agents;  // who goes another way ...
    std::vector<Path> paths;         // ... and which
  };
  enum class Step : std::uint8_t {
    kDone,
    kTooHard,  // it would take longer than a price is worth
    kStopped,  // a limit struck
  };

  void find_conflicts();
  void show_others();
  // The best split so far, by what its cheaper and its dearer side rise by.
  struct Choice {
    std::pair<Cost, Cost> gain{-1, -1};
    Split split;
  };

  bool in_conflict(AgentIndex a, AgentIndex b) const;
  void collect_splits();
  Step choose(Cost slack, std::span<const Split> last_resorts, const Limits& limits, Split& chosen);
  Step improve(Choice& choice, const Split& split, Cost slack, const Limits& limits);
  Step improve_by_sequences(Choice& choice, Cost slack, const Limits& limits);
  Split earliest() const;
  Step estimate(const AgentConstraint& demand, Cost slack, const Limits& limits, Cost& increase);
  Step least_cost(AgentIndex agent, const Constraint& more, Time cutoff, std::int64_t most_labels,
                  const Limits& limits, Time& cost);
  void affected(const AgentConstraint& demand, std::vector<AgentIndex>& agents) const;
  std::span<const Constraint> constraints_with(AgentIndex agent, const Constraint& more);
  Step make_side(const AgentConstraint& demand, Cost slack, const Limits& limits, Side& side);
  Step replan_one(AgentIndex agent, const Constraint& more, Time cutoff, const Limits& limits,
                  bool& found);
  Step replan(const AgentConstraint& demand, Cost slack, const Limits& limits, Side& side);
  bool bypass(const Side& side);
  NodePtr with_bypasses() const;
  NodePtr child(const NodePtr& parent, const AgentConstraint& demand, const Side& side) const;

  Time cost_of(AgentIndex agent) const { return static_cast<Time>(paths_[agent].size()) - 1; }

  const Problem& problem_;
  const Techniques techniques_;
  const std::uint64_t seed_;
  PathPlanner& planner_;
  Memory& memory_;
  FewestConflicts fewest_conflicts_;
  ConflictFinder finder_;
  ConflictAvoidanceTable others_;  // the paths in scope
  std::vector<Path> shown_;        // what others_ holds, by AgentIndex

  // Of the node entered.
  NodePtr node_;
  std::vector<AgentIndex> scope_;
  std::vector<Path> paths_;                           // by AgentIndex
  std::vector<std::vector<Constraint>> constraints_;  // by AgentIndex; canonical
  std::vector<Conflict> conflicts_;
  std::vector<Split> splits_;
  std::vector<AgentIndex> bypassed_;  // who was sent another way since

  std::array<Side, 2> sides_;
  std::vector<Constraint> extended_;
  std::vector<AgentIndex> affected_;
  std::vector<AgentIndex> in_conflict_;
  Path path_;
  std::int64_t steps_ = 0;
};

}  // namespace grove
