// SPDX-License-Identifier: MIT
// Prioritised planning (Erdmann and Lozano-Perez 1987; Silver 2005). An agent planned later takes
// the paths before it for walls, their rest at the end included, and may not come to rest where one
// of them still passes. So it fails when the walls shut it in, which is mostly the doing of a few
// agents that were planned too late: the one that fails is moved to the front and all is begun
// again (so did Bennewitz et al. 2002 with random exchanges; measured, this succeeds on far more
// crowded maps than random orders). Agents that shut out each other would take turns for ever:
// after as many failures as there are agents the order is drawn anew.
//
// To prove that an agent is shut in can take a hundred times what any path took. So a call that
// takes many times the most that one with a path took counts as failed - of more after each draw,
// lest an agent that is hard to plan be taken for one that cannot be.
#include "prioritized_planning.h"

#include <algorithm>
#include <utility>

namespace grove::detail {

void PrioritizedPlanning::begin(std::vector<AgentIndex> order) {
  order_ = std::move(order);
  failures_ = 0;
  begin_again();
}

void PrioritizedPlanning::begin_again() {
  paths_.clear();
  next_ = 0;
  ++attempts_;
}

std::int64_t PrioritizedPlanning::most_labels() const {
  const std::int64_t draws = failures_ / static_cast<std::int64_t>(order_.size());
  return (tuning_.planning_labels + tuning_.planning_labels_of_found * labels_of_found_)
         << std::min<std::int64_t>(draws, 30);
}

PrioritizedPlanning::Outcome PrioritizedPlanning::step(const Limits& limits,
                                                       std::int64_t patience) {
  if (next_ == order_.size()) return Outcome::kDone;
  const AgentIndex agent = order_[next_];
  const std::int64_t before = router_.expanded();
  const PathQuery query{.most_labels = std::min(patience, most_labels()),
                        .reservations = &paths_.reservations(),
                        .known_sequences = true};
  if (router_.find(agent, query, limits, path_) == PathOutcome::kFound) {
    labels_of_found_ = std::max(labels_of_found_, router_.expanded() - before);
    paths_.put(agent, std::move(path_));
    path_.clear();
    return ++next_ == order_.size() ? Outcome::kDone : Outcome::kWorking;
  }
  if (limits.stop_requested()) return Outcome::kStopped;
  if (patience < most_labels() && router_.expanded() - before >= patience) return Outcome::kPutOff;
  if (++failures_ % static_cast<std::int64_t>(order_.size()) == 0)
    random_.shuffle(order_);
  else
    std::rotate(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(next_),
                order_.begin() + static_cast<std::ptrdiff_t>(next_) + 1);
  begin_again();
  return Outcome::kWorking;
}

}  // namespace grove::detail
