// SPDX-License-Identifier: MIT
// Progress of large neighbourhood search (LNS) in a round of the primal search.
#pragma once

#include <algorithm>
#include <cstdint>

#include "model/assert.h"

namespace grove::detail {

// Decides when LNS has stalled (rule: "Rounds" at the head of primal_search.cpp). `work` is the
// effort of the primal search so far (PrimalSearch::work()), and `iterations` is the number of LNS
// iterations so far. One thread at a time.
class RoundProgress {
 public:
  // Begins a round. Its first plan is still sought, or is a plan that was just adopted.
  void begin_round(std::int64_t work) {
    GROVE_CHECK(work >= improved_at_work_, "effort never falls");
    began_at_work_ = work;
  }
  // Records that the round has a new plan, or that LNS has found its cheapest plan so far.
  void note_gain(std::int64_t work, std::int64_t iterations) {
    GROVE_CHECK(
        work >= began_at_work_ && work >= improved_at_work_ && iterations >= improved_at_iteration_,
        "effort and iterations never fall");
    improved_at_work_ = work;
    improved_at_iteration_ = iterations;
  }
  bool has_stalled(std::int64_t work, std::int64_t iterations, std::int64_t agents) const {
    GROVE_CHECK(improved_at_work_ >= began_at_work_, "a round stalls only after its first plan");
    const std::int64_t least = std::max(kStallNeighborhoods, kStallNeighborhoodsPerAgent * agents);
    return iterations - improved_at_iteration_ >= least &&
           work - improved_at_work_ >= improved_at_work_ - began_at_work_;
  }

 private:
  static constexpr std::int64_t kStallNeighborhoods = 200;  // failed iterations before a new round
  // Failed iterations per agent before a new round. Both numbers must be reached.
  static constexpr std::int64_t kStallNeighborhoodsPerAgent = 10;

  std::int64_t began_at_work_ = 0;
  std::int64_t improved_at_work_ = 0;
  std::int64_t improved_at_iteration_ = 0;
};

}  // namespace grove::detail
