// SPDX-License-Identifier: MIT
// Traffic-guided LaCAM: improves a plan by LaCAM with distances that avoid the plan's congestion.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "model/limits.h"
#include "model/plan.h"
#include "model/tuning.h"
#include "primal/lacam.h"
#include "primal/traffic.h"
#include "search/problem.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// Works in rounds: the traffic of the plans so far gives distances, and LaCAM guided by these makes
// the next plan. Slices may have any length. Deterministic: the same calls make the same plans,
// limits excepted. One thread at a time.
class TrafficGuidedLacam {
 public:
  enum class Outcome : std::uint8_t {
    kFound,    // the round has ended with a plan(); call learn() before the next run()
    kFailed,   // the round has ended without a plan
    kWorking,  // the slice is used up
    kStopped,  // a limit was reached, or so little memory is left that continuing would reach one
  };

  // `orders` as for LacamWithRestarts. `problem` and `tuning` must outlive this. `mean_cost`: mean
  // individual cost of an agent.
  TrafficGuidedLacam(const Problem& problem, std::vector<Sequence> orders, double mean_cost,
                     std::uint64_t seed, const Tuning& tuning);

  // Adds the traffic of a plan and begins a round.
  void learn(const Plan& plan);
  // Continues the round; call learn() first. After kFailed it begins another round.
  Outcome run(const Limits& limits, std::int64_t slice);

  const Plan& plan() const { return plan_; }
  // As PrimalSearch::work().
  std::int64_t work() const { return work_; }
  std::int64_t joint_steps() const { return joint_steps_; }

 private:
  bool make_field(const Limits& limits);
  Outcome search(const Limits& limits, std::int64_t slice);
  LegFields leg_fields() const;

  const Problem& problem_;
  const Tuning& tuning_;
  std::vector<Sequence> orders_;
  SplitMix64 dice_;  // generates the seeds
  Traffic traffic_;
  std::int64_t learnt_ = 0;                       // plans learnt
  std::map<DistanceView, DistanceField> fields_;  // by the distances in steps that they replace
  std::map<DistanceView, DistanceField>::iterator next_field_;
  std::unique_ptr<Lacam> lacam_;
  std::int64_t steps_left_ = 0;
  Plan plan_;
  std::int64_t work_ = 0;
  std::int64_t joint_steps_ = 0;
};

}  // namespace grove::detail
