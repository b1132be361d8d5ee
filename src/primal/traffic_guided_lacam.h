// SPDX-License-Identifier: MIT
// Traffic-guided LaCAM: finds a better plan by LaCAM with distances that avoid the congestion of
// earlier plans.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "model/limits.h"
#include "model/plan.h"
#include "model/tuning.h"
#include "planning/problem.h"
#include "primal/lacam.h"
#include "primal/traffic.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// Works in rounds. In each round LaCAM makes a plan, guided by distances that include the traffic
// of the plans learnt so far. Slices can have any length. Deterministic: the same calls yield the
// same plans, unless a limit is reached. One thread at a time.
class TrafficGuidedLacam {
 public:
  enum class Outcome : std::uint8_t {
    kFound,    // the round has ended with a plan(); call learn() before the next run()
    kFailed,   // the round has ended without a plan
    kWorking,  // the slice is used up
    kStopped,  // a limit was reached, or so little memory is left that continuing would reach one
  };

  // `orders` and `seed` are as for LacamWithRestarts. `mean_cost`: mean individual cost of the
  // agents. `problem` and `tuning` must outlive this object.
  TrafficGuidedLacam(const Problem& problem, std::vector<Sequence> orders, double mean_cost,
                     std::uint64_t seed, const Tuning& tuning);

  // Adds the traffic of `plan` and starts a round.
  void learn(const Plan& plan);
  // Continues the round for an effort of about `slice` (unit: work()). learn() must have been
  // called. After kFailed, starts another round.
  Outcome run(const Limits& limits, std::int64_t slice);

  const Plan& plan() const { return plan_; }
  // Effort spent so far; see PrimalSearch::work().
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
  std::int64_t learnt_ = 0;                       // number of plans learnt
  std::map<DistanceView, DistanceField> fields_;  // by the field in steps that it replaces
  std::map<DistanceView, DistanceField>::iterator next_field_;
  std::unique_ptr<Lacam> lacam_;
  std::int64_t steps_left_ = 0;
  Plan plan_;
  std::int64_t work_ = 0;
  std::int64_t joint_steps_ = 0;
};

}  // namespace grove::detail
