// SPDX-License-Identifier: MIT
// Lower bounds from unsatisfiable cores, by incremental SAT.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "cores/core_components.h"
#include "cores/path_model.h"
#include "cores/sat_solver.h"
#include "cores/totalizer.h"
#include "model/limits.h"
#include "model/plan.h"
#include "model/random.h"
#include "planning/agent_stops_cache.h"
#include "planning/problem.h"
#include "search/covering.h"
#include "search/techniques.h"

namespace grove::detail {

// Prices of the agents, and a function that makes a plan of their paths. Default: no prices.
struct PricedChoices {
  const Prices* prices = nullptr;
  std::function<Plan(const std::vector<CountedPath>&)> make_plan = {};
};

// Searches for an optimal plan by core-guided MaxSAT (OLL: Andres et al. 2012; Morgado, Dodaro and
// Marques-Silva 2014). The proof is at the head of core_search.cpp. One thread at a time.
// Repeatable: results depend only on the arguments, unless a limit is reached.
class CoreSearch {
 public:
  enum class Outcome : std::uint8_t {
    kWorking,
    kSolved,    // plan() costs lower_bound(), or no plan costs less than the cutoff
    kTooLarge,  // the search can prove nothing more: it would need too much memory
    kStopped,   // a limit was reached
  };

  // All arguments must outlive this object, except `stops`, which is copied. Uses at most about
  // `max_bytes`. Searches with different seeds find different cores; 0: agents in their order.
  CoreSearch(const Problem& problem, const AgentStopsCache& stops, Techniques techniques,
             std::size_t max_bytes, const Limits& limits, ProofLog* proof = nullptr,
             std::uint64_t seed = 0, PricedChoices choices = {});

  // Plans an agent, or calls the SAT solver for a limited number of conflicts. `cutoff`: plans of
  // this cost or more are of no interest; must not rise from call to call.
  Outcome step(Cost cutoff);

  // True once all agents are planned.
  bool is_set_up() const { return phase_ != Phase::kSetUp; }
  // Adds a proven statement about all plans: `excess.agents` together cost at least `excess.excess`
  // more than the sum of their least costs. If no core depends on any of these agents, one of the
  // next calls of step() raises the bound by it. Requires is_set_up().
  void add(const GroupExcess& excess);
  // See CoreComponents::take_excesses(). Requires agents without prices.
  std::vector<GroupExcess> take_excesses() { return components_.take_excesses(); }

  // Proven: no plan that costs less than the cutoff of the last step costs less than this.
  Cost lower_bound() const { return lower_bound_; }
  // The optimal plan, once one was found.
  const std::optional<Plan>& plan() const { return plan_; }

  // Effort so far (model/effort.h), and numbers of cores, of conflicts of the SAT solver, and of
  // conflicts of paths that became clauses.
  std::int64_t work() const { return model_.work(); }
  std::int64_t cores() const { return cores_; }
  std::int64_t sat_conflicts() const { return model_.sat_conflicts(); }
  std::int64_t path_conflicts() const { return model_.path_conflicts(); }

 private:
  enum class Phase : std::uint8_t { kSetUp, kSolve, kMinimize, kExhaust, kRelax };
  // An assumption of weight 1: "agent `agent` has at most this excess", "at most `count` of the
  // inputs of totalizer `totalizer` are true", or "an agent ends on this goal".
  struct Soft {
    Literal literal = 0;
    AgentIndex agent = -1;
    Time excess = 0;
    std::int32_t totalizer = -1;
    std::size_t count = 0;
    std::int32_t goal = -1;  // "this goal is used"; an index in goals_
  };
  // A totalizer, and the agents on which its inputs depend.
  struct Count {
    Totalizer totalizer;
    std::vector<AgentIndex> agents;
  };
  // The core that is being minimised, exhausted or replaced.
  struct Core {
    std::vector<Soft> softs;
    std::size_t next = 0;      // index of the literal to leave out next
    int retries = 0;           // models with new conflicts that are left for this literal
    std::size_t violated = 0;  // at least this many of `softs` are false in every plan
    Cost further = 0;          // further cores that a statement makes of the replacements
  };

  Outcome set_up();
  Outcome use_statement();
  void raise_by(const GroupExcess& excess);
  Outcome solve();
  Outcome use_model();
  bool add_unused_goals();
  Outcome minimize();
  Outcome exhaust();
  void start_relaxation();
  Outcome relax();
  void finish_relaxation();
  Outcome prove_cutoff();
  void accept_core();
  void log_core(std::int64_t sum) { model_.solver().log(FormulaKind::kCore, {sum}); }
  PathModel::Outcome raise(const Soft& soft);

  SatSolver::Result solve(std::span<const Soft> assumed, int max_conflicts);
  std::int64_t add_conflicts();
  void add_new_agents();
  std::vector<AgentIndex> agents_of(std::span<const Soft> softs) const;
  std::vector<Soft> failed(std::span<const Soft> assumed);
  Soft agent_soft(AgentIndex agent, Time excess);
  Soft count_soft(std::size_t totalizer, std::size_t count);
  Outcome stopped_or(Outcome outcome) const;

  const std::size_t max_bytes_;
  const Limits& limits_;
  Random random_;
  const bool is_shuffled_;
  PathModel model_;
  const PricedChoices choices_;
  std::vector<Count> counts_;
  std::vector<std::vector<AgentIndex>> goals_;  // by goal of a soft literal: the agents that may
                                                // end there
  std::vector<Soft> active_;                    // assumed
  std::vector<Soft> deferred_;                  // from relaxed cores; assumed after the next model
  Core core_;
  std::vector<Soft> replacements_;  // of the literals of core_
  CoreComponents components_;
  std::vector<GroupExcess> new_statements_;  // of add(); without clauses yet
  std::vector<GroupExcess> statements_;      // not used yet to raise the bound
  bool depends_on_cutoff_ = false;           // a hard clause was derived from the cutoff
  Phase phase_ = Phase::kSetUp;
  Cost cutoff_ = kInfiniteCost;
  Cost lower_bound_ = 0;
  std::optional<Plan> plan_;
  std::int64_t cores_ = 0;
};

}  // namespace grove::detail
