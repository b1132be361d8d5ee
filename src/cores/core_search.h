// SPDX-License-Identifier: MIT
// Lower bounds from unsatisfiable cores, by incremental SAT.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "conflicts/conflict.h"
#include "cores/path_clauses.h"
#include "cores/path_graph.h"
#include "cores/sat_solver.h"
#include "cores/totalizer.h"
#include "model/limits.h"
#include "model/plan.h"
#include "planning/agent_stops_cache.h"
#include "planning/conflict_avoidance_table.h"
#include "planning/free_order_sipp.h"
#include "planning/problem.h"
#include "search/covering.h"
#include "search/techniques.h"

namespace grove::detail {

// Searches for an optimal plan by core-guided MaxSAT (OLL: Andres et al. 2012; Morgado, Dodaro and
// Marques-Silva 2014), with lazily added conflicts as in Lazy CBS (Gange, Harabor and Stuckey, ICAPS
// 2019). The proof is at the head of core_search.cpp. One thread at a time. Repeatable: results
// depend only on the arguments, unless a limit is reached.
class CoreSearch {
 public:
  enum class Outcome : std::uint8_t {
    kWorking,
    kSolved,     // plan() costs lower_bound(), or no plan costs less than the cutoff
    kExhausted,  // the search can prove nothing more: it would need too much memory
    kStopped,    // a limit was reached
  };

  // All arguments must outlive this object. `stops` is copied. Uses at most about `max_bytes`.
  CoreSearch(const Problem& problem, const AgentStopsCache& stops, Techniques techniques,
             std::size_t max_bytes, const Limits& limits);
  ~CoreSearch();

  // Works for about a millisecond, or for the duration of a step of the SAT solver.
  Outcome step(Cost cutoff);

  // Adds a proven statement about all plans: `excess.agents` together cost at least `excess.excess`
  // more than the sum of their least costs. Ignored before all agents are planned, i.e. while
  // is_set_up() is false.
  void add(const GroupExcess& excess);
  bool is_set_up() const { return phase_ != Phase::kSetUp; }
  // Returns the statements of this kind that were proven since the last call, about groups of at
  // most kMaxGroup agents. They hold for all plans, whatever they cost.
  std::vector<GroupExcess> take_excesses() { return std::exchange(excesses_, {}); }
  static constexpr std::size_t kMaxGroup = 10;

  // Proven: no plan that costs less than the cutoff of the last step costs less than this.
  Cost lower_bound() const { return lower_bound_; }
  // The optimal plan, once one was found.
  const std::optional<Plan>& plan() const { return plan_; }

  // Effort so far (model/effort.h), number of cores, of conflicts of the SAT solver, and of conflicts
  // of paths that became clauses.
  std::int64_t work() const;
  std::int64_t cores() const { return cores_; }
  std::int64_t sat_conflicts() const { return solver_.conflicts(); }
  std::int64_t path_conflicts() const { return path_conflicts_; }
  std::size_t bytes() const;

 private:
  enum class Phase : std::uint8_t { kSetUp, kSolve, kMinimize, kExhaust };
  // An assumption of weight 1: "agent `agent` has at most this excess" or "at most `count` of the
  // inputs of totalizer `totalizer` are true".
  struct Soft {
    Literal literal = 0;
    AgentIndex agent = -1;
    Time excess = 0;
    std::int32_t totalizer = -1;
    std::size_t count = 0;
  };
  struct Agent {
    std::unique_ptr<PathGraph> graph;
    std::unique_ptr<PathClauses> clauses = nullptr;  // nullptr until a conflict needs them
    std::vector<PathGraph::Node> walk = {};
    bool has_path = true;  // false: the model says nothing about it
    bool is_limited = false;  // a hard clause limits its cost
    AgentIndex component = -1;  // index in components_; -1: in no core yet
  };

  Outcome set_up();
  Outcome solve();
  Outcome minimize();
  Outcome exhaust();
  Outcome relax();
  void connect_core();

  struct Count {
    Totalizer totalizer;
    std::vector<AgentIndex> agents;  // on which its inputs depend
  };

  // Agents that are connected by cores.
  struct CoreComponent {
    std::vector<AgentIndex> agents;
    Cost raised = 0;  // by the cores of these agents
  };

  SatSolver::Result solve(std::span<const Soft> assumed, int max_conflicts);
  std::vector<AgentIndex> agents_of(std::span<const Soft> softs) const;
  Soft count_soft(std::size_t index, std::size_t count);
  std::vector<Soft> failed(std::span<const Soft> assumed) const;
  std::vector<PathGraph::Node> walk_with_fewest_conflicts(const PathGraph& graph) const;
  void read_walks();
  std::int64_t add_conflicts();
  void add_split(const Conflict& conflict, const Split& split);
  PathClauses& clauses_of(AgentIndex agent);
  bool raise(AgentIndex agent, Time excess);
  Path path_of(const Agent& agent) const;
  Plan make_plan() const;

  const Problem& problem_;
  const Instance& instance_;
  const Techniques techniques_;
  const std::size_t max_bytes_;
  const Limits& limits_;
  AgentStopsCache stops_;
  FreeOrderSipp low_level_;
  ConflictFinder finder_;
  ConflictAvoidanceTable first_paths_;
  SatSolver solver_;
  PlaceConflicts place_conflicts_{solver_};
  std::vector<Agent> agents_;
  std::deque<Count> counts_;
  std::vector<Soft> active_;    // assumed
  std::vector<Soft> deferred_;  // from relaxed cores; assumed after the next model
  std::vector<Soft> core_;
  std::size_t next_in_core_ = 0;
  int retries_ = 0;
  std::size_t violated_ = 0;  // at least this many of core_ are violated
  std::vector<CoreComponent> components_;
  std::vector<GroupExcess> excesses_;  // see take_excesses()
  bool depends_on_cutoff_ = false;     // a hard clause was derived from the cutoff
  Phase phase_ = Phase::kSetUp;
  Cost cutoff_ = kInfiniteCost;
  Cost least_sum_ = 0;
  Cost lower_bound_ = 0;
  std::optional<Plan> plan_;
  std::vector<Path> paths_;  // by AgentIndex
  std::int64_t cores_ = 0;
  std::int64_t path_conflicts_ = 0;
  std::int64_t work_ = 0;
};

}  // namespace grove::detail
