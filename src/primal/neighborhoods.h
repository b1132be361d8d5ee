// SPDX-License-Identifier: MIT
// Choice of the agents that large neighbourhood search re-plans together (destroy operators).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/random.h"
#include "model/tuning.h"
#include "primal/planned_paths.h"
#include "primal/primal_low_level.h"
#include "search/problem.h"

namespace grove::detail {

// Chooses neighbourhoods of a few agents by several destroy operators. An operator is chosen more
// often the more it gained recently (adaptive large neighbourhood search: Ropke and Pisinger 2006;
// for MAPF: Li et al., IJCAI 2021). The operators are described at the head of the .cpp. One thread
// at a time.
class Neighborhoods {
 public:
  // All references must outlive this.
  Neighborhoods(const Problem& problem, const PrimalLowLevel& low_level, const PlannedPaths& paths,
                Random& random, const Tuning& tuning)
      : problem_(problem), low_level_(low_level), paths_(paths), random_(random), tuning_(tuning) {}

  // The next neighbourhood, in random order. All agents must have paths. Valid until the next call.
  const std::vector<AgentIndex>& choose();
  // Reports the cost reduction by the neighbourhood chosen last; 0 if there was none.
  void reward(Cost gain);

 private:
  enum Kind : std::uint8_t { kAgentBased, kRandom, kMapBased, kReducedCost };
  static constexpr int kKinds = 4;
  static constexpr std::int64_t kFew = 2;  // a smaller neighbourhood is filled with random agents

  std::int64_t max_size() const;
  Kind choose_kind();
  void add(AgentIndex agent);
  bool full() const { return std::ssize(chosen_) >= wanted_; }
  // Number of operators that can be used: kReducedCost needs a dual solution.
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
  int seen_prices_ = 0;                      // PrimalLowLevel::price_changes() of reduced_cost_
  std::vector<ScaledCost> reduced_cost_;     // by agent: of its path
  std::vector<std::int64_t> seen_editions_;  // by agent: edition of the path of reduced_cost_
  std::vector<Place> queue_;
  std::vector<std::int32_t> seen_at_;  // by place: the last breadth-first search that reached it
  std::int32_t search_ = 0;
};

}  // namespace grove::detail
