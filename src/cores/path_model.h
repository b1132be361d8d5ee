// SPDX-License-Identifier: MIT
// The paths of all agents as a SAT formula.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "conflicts/conflict.h"
#include "cores/path_clauses.h"
#include "cores/path_graph.h"
#include "cores/place_conflicts.h"
#include "cores/sat_solver.h"
#include "model/limits.h"
#include "model/plan.h"
#include "planning/agent_prices.h"
#include "planning/agent_stops_cache.h"
#include "planning/conflict_avoidance_table.h"
#include "planning/free_order_sipp.h"
#include "planning/problem.h"
#include "search/covering.h"
#include "search/techniques.h"

namespace grove::detail {

// Clauses that every valid plan satisfies, with literals for limits on the costs of agents. Clauses
// for an agent, and for conflicts between agents, are added when a model needs them, as in Lazy CBS
// (Gange, Harabor and Stuckey, ICAPS 2019). The proof is at the head of path_model.cpp. One thread
// at a time.
class PathModel {
 public:
  enum class Outcome : std::uint8_t {
    kDone,
    kWorking,   // the function must be called again, with the same arguments
    kTooLarge,  // an agent has no path, or its paths would need too much memory
    kStopped,   // a limit was reached
  };

  // All arguments must outlive this object, except `stops`, which is copied. `prices`: those of
  // `stops`; nullptr: none.
  PathModel(const Problem& problem, const AgentStopsCache& stops, Techniques techniques,
            const Limits& limits, ProofLog* proof = nullptr, const Prices* prices = nullptr);

  // Plans the next agent. Must be called until is_complete(), before all functions that follow.
  Outcome plan_next_agent();
  bool is_complete() const { return std::ssize(agents_) == problem_.instance.agent_count(); }
  // Sum of the agents' least costs. With prices: of their least prices, minus Prices::constant.
  Cost least_sum() const { return least_sum_; }

  SatSolver& solver() { return solver_; }
  // Literal for "the agent costs at most `excess` more than its least cost".
  Literal within(AgentIndex agent, Time excess) { return clauses_of(agent).within(excess); }
  // Extends the clauses of an agent by one unit of excess, in steps of limited effort.
  Outcome grow(AgentIndex agent);
  // Adds a hard clause: the agent costs at most `excess` more than its least cost.
  void limit(AgentIndex agent, Time excess);
  // Adds clauses for a statement about all plans; perhaps not all that it implies.
  void add(const GroupExcess& excess);
  // Returns the agents that have had clauses since the last call and had none before. The other
  // agents keep a path of least cost.
  std::vector<AgentIndex> take_new_agents() { return std::exchange(new_agents_, {}); }

  // With prices, after a model without conflicts: the goals with a price on which no agent that
  // would pay for it ends, without
  // those that were returned before. Each of them adds its price to the cost of the plan, unless
  // `is_used` is true, a literal that depends on `agents`.
  struct UnusedGoal {
    Place place;
    Time price;
    Literal is_used;
    std::vector<AgentIndex> agents;
  };
  std::vector<UnusedGoal> take_unused_goals();

  // Solves under assumptions, which depend on the agents `needed` only.
  SatSolver::Result solve(std::vector<Literal> assumptions, std::span<const AgentIndex> needed,
                          int max_conflicts);
  // After kSatisfiable: reads the paths of the model. Adds clauses for their conflicts, and with
  // prices for visits that are missing or too many. Returns the number of both.
  std::int64_t add_conflicts();
  // Decisions of the solver try the paths of the model that was read last first.
  void prefer_paths();
  // True if the model that was read last has a path for each agent.
  bool has_all_paths() const;
  // The plan of these paths. Requires has_all_paths(), that they have no conflicts, and agents
  // without prices.
  Plan plan() const;
  // The same paths, by AgentIndex, with the stops that they count.
  std::vector<CountedPath> counted_paths() const;

  // Numbers of conflicts of the SAT solver, and of conflicts of paths that became clauses.
  std::int64_t sat_conflicts() const { return solver_.conflicts(); }
  std::int64_t path_conflicts() const { return path_conflicts_; }
  // Effort so far (model/effort.h).
  std::int64_t work() const { return work_ + solver_.work(); }
  std::size_t bytes() const;

 private:
  struct Agent {
    std::unique_ptr<PathGraph> graph;
    std::unique_ptr<PathClauses> clauses = nullptr;  // nullptr until a conflict needs them
    std::vector<PathGraph::Node> walk = {};
    bool has_path = true;     // false: the model lets it cost more than the clauses cover
    bool is_limited = false;  // by limit()
  };

  // Which clauses on the number of visits to a task exist?
  struct NeedClauses {
    bool at_least = false;
    bool at_most = false;
  };

  std::optional<Time> least_cost(AgentStops& stops);
  bool pays_for(AgentIndex agent, Place goal) const;
  int visits_of(const Prices::Need& need, bool without_path) const;
  std::int64_t add_needs();
  void add_at_most(std::vector<Literal> literals, std::size_t count);
  Outcome grow(PathGraph& graph, Time excess, std::size_t max_visits);
  std::vector<PathGraph::Node> walk_with_fewest_conflicts(const PathGraph& graph) const;
  PathClauses& clauses_of(AgentIndex agent);
  void read_walks();
  void add_split(const Conflict& conflict, const Split& split);
  Path path_of(const Agent& agent) const;

  const Problem& problem_;
  const Techniques techniques_;
  const Limits& limits_;
  const Prices* const prices_;
  std::vector<NeedClauses> need_clauses_;  // by index in Prices::needs
  std::vector<bool> is_goal_returned_;     // by index in Prices::goals
  AgentStopsCache stops_;
  FreeOrderSipp low_level_;
  ConflictFinder finder_;
  ConflictAvoidanceTable first_paths_;
  SatSolver solver_;
  PlaceConflicts place_conflicts_{solver_};
  std::vector<Agent> agents_;
  std::vector<Path> paths_;  // by AgentIndex
  std::vector<AgentIndex> new_agents_;
  Cost least_sum_ = 0;
  std::int64_t path_conflicts_ = 0;
  std::int64_t work_ = 0;
};

}  // namespace grove::detail
