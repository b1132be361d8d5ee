// SPDX-License-Identifier: MIT
// Destroy operators: choose the agents that large neighbourhood search re-plans together.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/random.h"
#include "model/tuning.h"
#include "planning/planned_paths.h"
#include "planning/problem.h"
#include "primal/primal_low_level.h"

namespace grove::detail {

// Chooses neighbourhoods of a few agents by several destroy operators. The more an operator gained
// recently, the more often it is chosen (adaptive large neighbourhood search: Ropke and Pisinger
// 2006; for MAPF: Li et al., IJCAI 2021). The operators are described at the head of the .cpp. One
// thread at a time.
class Neighborhoods {
 public:
  // All references must outlive this object.
  Neighborhoods(const Problem& problem, const PrimalLowLevel& low_level, const PlannedPaths& paths,
                Random& random, const Tuning& tuning)
      : problem_(problem), low_level_(low_level), paths_(paths), random_(random), tuning_(tuning) {}

  // Returns the next neighbourhood, in random order; valid until the next call. All agents must
  // have paths.
  const std::vector<AgentIndex>& choose();
  // Records the cost reduction by the neighbourhood chosen last; 0 if the cost was not reduced.
  void reward(Cost gain);

 private:
  enum Kind : std::uint8_t { kAgentBased, kRandom, kMapBased, kReducedCost };
  static constexpr int kKinds = 4;
  static constexpr std::int64_t kFew = 2;  // smaller neighbourhoods get random agents

  // The reduced costs of the agents' paths under the multipliers of a dual solution.
  struct ReducedCosts {
    int prices = 0;                      // PrimalLowLevel::price_changes() of the dual solution
    std::vector<ScaledCost> of;          // by agent
    std::vector<std::int64_t> versions;  // by agent: version of the path priced
  };
  // Breadth-first search over places.
  struct PlaceSearch {
    std::vector<Place> queue;
    std::vector<std::int32_t> reached_by;  // by place: the last search that reached it
    std::int32_t number = 0;               // of the current search
  };

  std::int64_t max_size() const;
  Kind choose_kind();
  void add(AgentIndex agent);
  bool full() const { return std::ssize(chosen_) >= wanted_; }
  // Number of usable operators: without a dual solution, all except kReducedCost.
  int kinds() const { return low_level_.dual_solution() == nullptr ? kReducedCost : kKinds; }
  void add_anyone();
  void add_delayed();
  AgentIndex some_delayed_agent();
  void add_blocking_agents(AgentIndex agent, const Path& path, Time late);
  void add_by_reduced_cost();
  AgentIndex agent_by_reduced_cost();
  void update_reduced_costs();
  const Path& wanted_path(AgentIndex agent) const;
  void add_around_spot();
  void add_visitors(Place place, Time time);

  const Problem& problem_;
  const PrimalLowLevel& low_level_;
  const PlannedPaths& paths_;
  Random& random_;
  const Tuning& tuning_;
  std::array<double, kKinds> weights_{1, 1, 1, 1};
  Kind kind_ = kRandom;
  std::int64_t wanted_ = 0;
  std::int64_t failures_ = 0;  // neighbourhoods since the last cost reduction
  std::vector<AgentIndex> chosen_;
  ReducedCosts reduced_costs_;
  PlaceSearch near_;
};

}  // namespace grove::detail
