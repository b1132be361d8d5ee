// SPDX-License-Identifier: MIT
// One search over configurations, from its seed to its end.
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

  // As LacamWithRestarts. `guide`: by what agents find their ways, as far as it leads; its fields
  // must outlive this.
  Lacam(const Problem& problem, std::span<const Sequence> orders, std::uint64_t seed,
        const LegFields* guide = nullptr);
  Lacam(const Lacam&) = delete;
  Lacam& operator=(const Lacam&) = delete;

  // Makes at most `steps` joint steps and takes off what it made.
  Outcome run(const Limits& limits, std::int64_t& steps);
  const std::optional<Plan>& plan() const { return plan_; }
  std::int64_t configurations() const { return configurations_.count(); }

 private:
  using Id = Configurations::Id;
  // Steps since an agent was last at rest, and 1 at the start.
  using Age = std::uint16_t;
  static constexpr Age kArrived = 0;
  static constexpr Age kOldest = UINT16_MAX;
  using ConstraintId = std::int32_t;
  static constexpr ConstraintId kNone = -1;

  // A constraint stands for itself and its ancestors; its depth says which agent it tells.
  struct Constraint {
    ConstraintId above;
    ConstraintId next;  // in its configuration's queue
    State state;
    std::int32_t depth;
  };

  // What there is to know about a configuration beside its places.
  struct Node {
    Id parent;
    ConstraintId first;  // the queue of its constraints
    ConstraintId last;
  };

  std::size_t agents() const { return agents_.size(); }
  bool has_room(const Limits& limits) const;
  void start(const Problem& problem);
  void add_constraint(Id id, ConstraintId above, State state, std::int32_t depth);
  ConstraintId take_constraint(Id id);
  void expand(Id id);
  void rank_agents(Id id);
  void collect_orders(ConstraintId constraint);
  void branch(Id id, ConstraintId constraint);
  void arrive(Id from, std::span<const State> states);
  void add_node(Id id, Id parent);
  void leave_guide();
  Age age_of(std::size_t agent, Id parent, Standing place);
  bool at_rest(std::size_t agent, Standing place) const {
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

  // Of the configuration being expanded.
  Id ranked_ = -1;
  std::vector<AgentIndex> ranking_;  // by priority
  std::vector<AgentIndex> by_way_;   // at the start, the longest way first: breaks ties
  std::vector<LacamConstraint> orders_;
  std::vector<Standing> places_;
  std::vector<State> next_;
};

}  // namespace grove::detail
