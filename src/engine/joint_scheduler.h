// SPDX-License-Identifier: MIT
// Decides when the search over joint states gets effort, and runs it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "joint/epea_star.h"
#include "model/tuning.h"

namespace grove::detail {

// The scheduling rule is at the head of the .cpp. One thread at a time.
class JointScheduler {
 public:
  // `instance` and `tuning` must outlive this object. If `wanted` is false, or if there are more
  // than EpeaStar::kMaxAgents agents, the search is never due.
  JointScheduler(const Instance& instance, const Tuning& tuning, bool wanted);

  // Records `work` units of effort of the tree search and the primal search.
  void add_other_work(std::int64_t work) { others_ += work; }
  bool due() const;
  // Runs the search for about a millisecond. Returns its lower bound, in the sense of
  // SharedBounds::prove(); 0 if EpeaStar::make() returns nullptr.
  Cost step(Cost cutoff, const Limits& limits);
  // Returns an optimal plan once it is found, else nullopt.
  std::optional<Plan> plan() const;
  std::int64_t states() const { return states_; }

 private:
  const Instance& instance_;
  const Tuning& tuning_;
  bool over_;
  std::int64_t others_ = 0;
  std::int64_t states_ = 0;
  std::unique_ptr<EpeaStar> search_;  // made when first due
};

}  // namespace grove::detail
