// SPDX-License-Identifier: MIT
// From a plan to one in which agents keep out of each other's way: by configuration search again.
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

// Goes round by round: the traffic of the plans so far makes distances, and a search by these makes
// a plan. In slices as short as one likes. The same calls make the same plans, limits aside.
class TrafficGuidedLacam {
 public:
  enum class Outcome : std::uint8_t {
    kFound,    // a round has ended with a plan(): the next one wants to learn
    kFailed,   // without one
    kWorking,  // the slice is used up
    kStopped,  // a limit struck, or so little memory is left that going on would make one strike
  };

  // `orders` as for LacamWithRestarts. `problem` and `tuning` must outlive this. `mean_cost`: of
  // an agent that is alone.
  TrafficGuidedLacam(const Problem& problem, std::vector<Sequence> orders, double mean_cost,
                     std::uint64_t seed, const Tuning& tuning);

  // Begins a round after the traffic of this plan, too.
  void learn(const Plan& plan);
  // To be called after learn(), and after kFailed, which begins another round.
  Outcome run(const Limits& limits, std::int64_t slice);

  const Plan& plan() const { return plan_; }
  // As that of a PrimalSearch.
  std::int64_t work() const { return work_; }
  std::int64_t joint_steps() const { return joint_steps_; }

 private:
  bool make_field(const Limits& limits);
  Outcome search(const Limits& limits, std::int64_t slice);
  LegFields leg_fields() const;

  const Problem& problem_;
  const Tuning& tuning_;
  std::vector<Sequence> orders_;
  SplitMix64 dice_;  // the seeds
  Traffic traffic_;
  std::int64_t learnt_ = 0;                       // plans
  std::map<DistanceView, DistanceField> fields_;  // by the distances that they stand for
  std::map<DistanceView, DistanceField>::iterator next_field_;
  std::unique_ptr<Lacam> lacam_;
  std::int64_t steps_left_ = 0;
  Plan plan_;
  std::int64_t work_ = 0;
  std::int64_t joint_steps_ = 0;
};

}  // namespace grove::detail
