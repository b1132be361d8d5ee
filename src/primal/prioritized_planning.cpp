// SPDX-License-Identifier: MIT
// Prioritised planning (Erdmann and Lozano-Perez 1987; Silver 2005). An agent planned later takes
// the paths before it for walls, their rest at the end included, and may not come to rest where one
// of them still passes. So it fails when the walls shut it in, which is mostly the doing of a few
// agents that were planned too late: the one that fails is moved to the front and all is begun
// again (so did Bennewitz et al. 2002 with random exchanges; measured, this succeeds on far
// more crowded maps than random orders). Agents that shut out each other would take turns for ever:
// after as many failures as there are agents the order is drawn anew.
//
// Where what is there took long it is not given up for one failure: only those that are in the way
// of the agent's own best path are planned anew, after it, unless it fails again. The plans are a
// little dearer: on room-64-64-8 with 100 agents and 300 tasks, scenarios 2, 3 and 5, by 0.4 to
// 3 %, and found no sooner there.
//
// To prove that an agent is shut in can take a hundred times what any path took. So a call that
// takes many times the most that one with a path took counts as failed - of more after each draw,
// lest an agent that is hard to plan be taken for one that cannot be.
//
// The heuristic knows nothing of those planned before. Where the agent's way is long and they are
// many, so are the labels with f below the cost of its best path: the last agents of 1,000 on a map
// of 256x256 cells took a million each, all before them a thousand or two. So the best path is
// looked for with some patience only, then any, greedily. Mostly it is an agent whose destination
// others pass long after its own cost.
#include "primal/prioritized_planning.h"

#include <algorithm>
#include <utility>

#include "primal/blocking_agents.h"

namespace grove::detail {
namespace {

constexpr int kGreedPercent = 30;

}  // namespace

void PrioritizedPlanning::begin(std::vector<AgentIndex> order) {
  order_ = std::move(order);
  failures_ = 0;
  greedily_ = false;
  begin_again();
}

void PrioritizedPlanning::begin_again() {
  paths_.clear();
  next_ = 0;
  labels_of_order_ = 0;
  has_failed_.assign(order_.size(), false);
  ++attempts_;
}

std::int64_t PrioritizedPlanning::label_limit() const {
  const std::int64_t draws = failures_ / static_cast<std::int64_t>(order_.size());
  return (tuning_.planning_labels + tuning_.planning_labels_of_found * labels_of_found_)
         << std::min<std::int64_t>(draws, 30);
}

std::int64_t PrioritizedPlanning::most_exact_labels() const {
  return tuning_.planning_exact_labels + tuning_.planning_exact_labels_of_found * labels_of_exact_ /
                                             std::max(found_exactly_, std::int64_t{1});
}

PrioritizedPlanning::Outcome PrioritizedPlanning::step(const Limits& limits,
                                                       std::int64_t patience) {
  if (next_ == order_.size()) return Outcome::kDone;
  const AgentIndex agent = order_[next_];
  const std::int64_t before = router_.expanded();
  const std::int64_t most =
      greedily_ ? label_limit() : std::min(label_limit(), most_exact_labels());
  const PathQuery query{.label_limit = std::min(patience, most),
                        .reservations = &paths_.reservations(),
                        .inflation_percent = greedily_ ? kGreedPercent : 0,
                        .known_sequences = true};
  const PathOutcome outcome = router_.find(agent, query, limits, path_);
  const std::int64_t labels = router_.expanded() - before;
  labels_of_order_ += labels;
  if (outcome == PathOutcome::kFound) {
    note_labels(labels);
    paths_.put(agent, std::move(path_));
    path_.clear();
    greedily_ = false;
    return ++next_ == order_.size() ? Outcome::kDone : Outcome::kWorking;
  }
  if (limits.stop_requested()) return Outcome::kStopped;
  if (patience < most && labels >= patience) return Outcome::kPutOff;
  if (!greedily_ && most < label_limit() && labels >= most) {
    greedily_ = true;
    return Outcome::kWorking;
  }
  ++failures_;
  greedily_ = false;
  if (labels_of_order_ < tuning_.planning_labels_to_keep || has_failed_[agent])
    begin_with_next();
  else
    remove_blocking_agents(agent);
  return Outcome::kWorking;
}

// Who is in the way of the agent's own best path loses its path, and comes after it.
void PrioritizedPlanning::remove_blocking_agents(AgentIndex agent) {
  has_failed_[agent] = true;
  std::vector<bool> gone(order_.size(), false);
  for_each_blocking_agent(world_, paths_.reservations(), agent, router_.individual_path(agent), 0,
                          [&](AgentIndex other) {
                            gone[other] = true;
                            return true;
                          });
  const auto planned = order_.begin() + static_cast<std::ptrdiff_t>(next_);
  const auto first_gone = std::stable_partition(order_.begin(), planned,
                                                [&](AgentIndex other) { return !gone[other]; });
  for (auto other = first_gone; other != planned; ++other) paths_.take(*other);
  std::rotate(first_gone, planned, planned + 1);
  next_ = static_cast<std::size_t>(first_gone - order_.begin());
}

void PrioritizedPlanning::begin_with_next() {
  if (failures_ % std::ssize(order_) == 0)
    random_.shuffle(order_);
  else
    std::rotate(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(next_),
                order_.begin() + static_cast<std::ptrdiff_t>(next_) + 1);
  begin_again();
}

void PrioritizedPlanning::note_labels(std::int64_t labels) {
  labels_of_found_ = std::max(labels_of_found_, labels);
  if (greedily_) return;
  labels_of_exact_ += labels;
  ++found_exactly_;
}

}  // namespace grove::detail
