// SPDX-License-Identifier: MIT
// LaCAM without restarts: one depth-first search over configurations.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "primal/configurations.h"
#include "primal/lacam_with_restarts.h"
#include "primal/pibt_generator.h"

namespace grove::detail {

class Lacam {
 public:
  using Outcome = LacamWithRestarts::Outcome;

  // `problem`, `orders` and `seed` are as for LacamWithRestarts. `guide`: distance fields that
  // agents follow until a configuration is reached a second time; nullptr: distances in steps. The
  // fields must outlive this object.
  Lacam(const Problem& problem, std::span<const Sequence> orders, std::uint64_t seed,
        const LegFields* guide = nullptr);
  Lacam(const Lacam&) = delete;
  Lacam& operator=(const Lacam&) = delete;

  // Makes at most `steps` joint steps, failed attempts included, and subtracts their number from
  // `steps`.
  Outcome run(const Limits& limits, std::int64_t& steps);
  const std::optional<Plan>& plan() const { return plan_; }
  std::int64_t configurations() const { return configurations_.count(); }

 private:
  using Id = Configurations::Id;
  // Joint steps since an agent was last where it may rest; 1 for an agent that starts elsewhere.
  using Age = std::uint16_t;
  static constexpr Age kArrived = 0;
  static constexpr Age kOldest = UINT16_MAX;
  using ConstraintId = std::int32_t;
  static constexpr ConstraintId kNone = -1;

  // A node of a LaCAM constraint tree. It represents the constraints of the node and its ancestors.
  // A node at depth d > 0 constrains the agent with the d-th highest priority.
  struct Constraint {
    ConstraintId above;
    ConstraintId next;  // next node in the configuration's queue
    State state;
    std::int32_t depth;
  };

  // Search data of a configuration.
  struct Node {
    Id parent;
    ConstraintId first;  // first node in its constraint queue
    ConstraintId last;
  };

  // The agents of a configuration, by descending priority.
  struct Ranking {
    Id of = -1;
    std::vector<AgentIndex> agents;
    std::vector<AgentIndex> by_distance;  // at the start, longest first: breaks ties
  };

  std::size_t agents() const { return agents_.size(); }
  bool has_room(const Limits& limits) const;
  void start(const Problem& problem);
  void add_constraint(Id id, ConstraintId above, State state, std::int32_t depth);
  ConstraintId take_constraint(Id id);
  void expand(Id id);
  void rank_agents(Id id);
  void collect_constraints(ConstraintId constraint);
  void branch(Id id, ConstraintId constraint);
  void arrive(Id from, std::span<const State> states);
  void add_node(Id id, Id parent);
  void leave_guide();
  Age age_of(std::size_t agent, Id parent, AgentState place);
  bool at_rest(std::size_t agent, AgentState place) const {
    return agents_[agent].may_rest(place.stage, place.state);
  }
  bool is_end(Id id);
  Plan make_plan(Id end);

  const Instance& instance_;
  std::vector<VisitStages> agents_;
  SplitMix64 dice_;
  PibtGenerator generator_;
  Configurations configurations_;
  RowBlocks<Age> ages_;
  std::vector<Node> nodes_;  // by Id
  std::vector<Constraint> constraints_;
  std::vector<Id> stack_;
  std::optional<Plan> plan_;
  bool is_guided_;

  // Data of the configuration that is being expanded.
  Ranking ranking_;
  std::vector<LacamConstraint> orders_;
  std::vector<AgentState> places_;
  std::vector<State> next_;
};

}  // namespace grove::detail
