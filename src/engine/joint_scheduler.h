// SPDX-License-Identifier: MIT
// The search over joint states, and when it is its turn.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "joint/epea_star.h"
#include "model/tuning.h"

namespace grove::detail {

// The rule is at the head of the .cpp. For one thread at a time.
class JointScheduler {
 public:
  // `instance` must outlive this. `wanted`: else it is never due.
  JointScheduler(const Instance& instance, const Tuning& tuning, bool wanted);

  // So much was done beside it.
  void add_other_work(std::int64_t work) { others_ += work; }
  bool due() const;
  // About a millisecond of it. Proven, as Ledger::prove has it.
  Cost step(Cost cutoff, const Limits& limits);
  // An optimal plan, as soon as there is one.
  std::optional<Plan> plan() const;
  std::int64_t states() const { return states_; }

 private:
  const Instance& instance_;
  const Tuning& tuning_;
  bool over_;
  std::int64_t others_ = 0;
  std::int64_t states_ = 0;
  std::unique_ptr<EpeaStar> search_;  // made when it is first due
};

}  // namespace grove::detail
