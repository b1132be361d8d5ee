// SPDX-License-Identifier: MIT
// Restarts of LaCAM (lacam.cpp). Each search has a new seed and twice the step limit of the
// previous search. Most searches end within a few more steps than the plan has, or do not end in
// reasonable time. *Measured*: of 300 dense instances (50 agents on some 120 cells with dead ends),
// 291 were solved with the first seed within 20,000 steps, and 7 of the other 9 with one of two
// further seeds. Because the limit doubles, a search without a solution is still exhausted
// eventually.
#include "primal/lacam_with_restarts.h"

#include <algorithm>
#include <vector>

#include "model/assert.h"
#include "primal/lacam.h"

namespace grove::detail {

class LacamWithRestarts::Search {
 public:
  Search(const Problem& problem, std::span<const Sequence> orders, std::uint64_t seed,
         std::int64_t first_steps)
      : problem_(problem), orders_(orders.begin(), orders.end()), dice_(seed), steps_(first_steps) {
    begin();
  }

  Outcome run(const Limits& limits, std::int64_t slice) {
    for (;;) {
      const std::int64_t allowed = std::min(slice, left_);
      std::int64_t unused = allowed;
      const Outcome outcome = lacam_->run(limits, unused);
      const std::int64_t made = allowed - unused;
      GROVE_CHECK(0 <= made && made <= allowed, "a search makes at most the steps of its slice");
      slice -= made;
      left_ -= made;
      steps_made_ += made;
      if (outcome != Outcome::kWorking) return outcome;
      if (left_ == 0) begin();
      if (slice <= 0) return outcome;
    }
  }
  const std::optional<Plan>& plan() const { return lacam_->plan(); }
  std::int64_t steps() const { return steps_made_; }
  std::int64_t configurations() const { return lacam_->configurations(); }

 private:
  void begin() {
    lacam_.reset();
    lacam_ = std::make_unique<Lacam>(problem_, orders_, dice_.next());
    left_ = steps_;
    steps_ *= 2;
  }

  const Problem& problem_;
  std::vector<Sequence> orders_;
  SplitMix64 dice_;  // generates the seeds
  std::unique_ptr<Lacam> lacam_;
  std::int64_t steps_made_ = 0;
  std::int64_t left_ = 0;  // steps left for the current search
  std::int64_t steps_;     // step limit of the next search
};

LacamWithRestarts::LacamWithRestarts(const Problem& problem, std::span<const Sequence> orders,
                                     std::uint64_t seed, std::int64_t first_steps)
    : search_(std::make_unique<Search>(problem, orders, seed, first_steps)) {}
LacamWithRestarts::~LacamWithRestarts() = default;
LacamWithRestarts::LacamWithRestarts(LacamWithRestarts&&) noexcept = default;
LacamWithRestarts& LacamWithRestarts::operator=(LacamWithRestarts&&) noexcept = default;

LacamWithRestarts::Outcome LacamWithRestarts::run(const Limits& limits, std::int64_t slice) {
  return search_->run(limits, slice);
}

const std::optional<Plan>& LacamWithRestarts::plan() const {
  return search_->plan();
}

std::int64_t LacamWithRestarts::steps() const {
  return search_->steps();
}

std::int64_t LacamWithRestarts::configurations() const {
  return search_->configurations();
}

}  // namespace grove::detail
