// SPDX-License-Identifier: MIT
// Which agents to plan anew together.
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

// Chooses neighbourhoods of a few agents, of some kinds, each as often as it did well of late
// (adaptive large neighbourhood search: Ropke and Pisinger 2006; for MAPF: Li et al., IJCAI 2021).
class Neighborhoods {
 public:
  // All must outlive this.
  Neighborhoods(const Problem& problem, const PrimalLowLevel& router, const PlannedPaths& paths,
                Random& random, const Tuning& tuning)
      : problem_(problem), router_(router), paths_(paths), random_(random), tuning_(tuning) {}

  // The next one, in random order; all agents must have paths. Valid until the next call.
  const std::vector<AgentIndex>& choose();
  // How much cheaper the plan became by the neighbourhood chosen last.
  void reward(Cost gain);

 private:
  enum Kind : std::uint8_t { kAgentBased, kRandom, kMapBased, kReducedCost };
  static constexpr int kKinds = 4;
  static constexpr std::int64_t kFew = 2;  // fewer are filled up with anyone

  std::int64_t most_wanted() const;
  Kind choose_kind();
  void add(AgentIndex agent);
  bool full() const { return std::ssize(chosen_) >= wanted_; }
  // All of them, or without those that ask for prices where there are none.
  int kinds() const { return router_.prices() == nullptr ? kReducedCost : kKinds; }
  void add_anyone();
  void add_delayed();
  AgentIndex some_delayed_agent();
  void add_those_in_the_way(AgentIndex agent, const Path& path, Time late);
  void add_by_reduced_cost();
  AgentIndex some_overpaying_agent();
  void update_reduced_costs();
  const Path& wanted_path(AgentIndex agent) const;
  void add_around_spot();
  void add_visitors(Place place, Time time);

  const Problem& problem_;
  const PrimalLowLevel& router_;
  const PlannedPaths& paths_;
  Random& random_;
  const Tuning& tuning_;
  std::array<double, kKinds> weights_{1, 1, 1, 1};
  Kind kind_ = kRandom;
  std::int64_t wanted_ = 0;
  std::int64_t in_vain_ = 0;  // neighbourhoods since one that gained
  std::vector<AgentIndex> chosen_;
  int seen_prices_ = 0;                      // Router::price_changes() then
  std::vector<ScaledCost> reduced_cost_;     // by agent: above its price
  std::vector<std::int64_t> seen_editions_;  // by agent: of the path of which that is so
  std::vector<Place> queue_;
  std::vector<std::int32_t> seen_at_;  // by place: the search that saw it
  std::int32_t search_ = 0;
};

}  // namespace grove::detail
