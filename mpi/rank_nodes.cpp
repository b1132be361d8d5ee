// SPDX-License-Identifier: MIT
#include "mpi/rank_nodes.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "model/assert.h"

namespace grove::detail {

RankNodes::RankNodes(ChildLinks& children)
    : children_(children),
      latest_(static_cast<std::size_t>(children.count())),
      in_transit_(latest_.size()),
      children_of_this_epoch_(children.count()) {
  for (std::size_t child = 0; child < latest_.size(); ++child) bounds_.insert(kInfiniteCost);
}

// A child handles AssignNodes messages in sending order, so its status covers the earliest
// assignments.
void RankNodes::update(int child, message::Status status) {
  const auto place = static_cast<std::size_t>(child);
  message::Status& latest = latest_.at(place);
  std::deque<Cost>& sent = in_transit_[place];
  const std::int64_t arrived = status.assigned - latest.assigned;
  if (arrived < 0 || arrived > std::ssize(sent) || status.epoch < latest.epoch ||
      status.epoch > epoch_)
    throw std::invalid_argument("coordinator: status does not match the messages to the rank");
  GROVE_CHECK(status.expanded >= latest.expanded && status.proven >= latest.proven,
              "a child's number of expanded nodes and proven bound never fall");
  GROVE_CHECK(status.live || status.open == 0, "a child without live nodes has no open one");
  bounds_.insert(status.bound);
  erase_bound(latest.bound);
  for (std::int64_t i = 0; i < arrived; ++i) {
    erase_bound(sent.front());
    sent.pop_front();
    --assignments_in_transit_;
  }
  add(latest, -1);
  add(status, 1);
  latest = std::move(status);
  GROVE_CHECK(std::ssize(bounds_) == std::ssize(latest_) + assignments_in_transit_,
              "each latest status and each assignment in transit has one bound");
  GROVE_ASSERT(assignments_in_transit_ == std::accumulate(in_transit_.begin(), in_transit_.end(),
                                                          std::int64_t{0},
                                                          [](std::int64_t sum, const auto& bounds) {
                                                            return sum + std::ssize(bounds);
                                                          }),
               "the assignments in transit are those of all children");
}

void RankNodes::erase_bound(Cost bound) {
  const auto found = bounds_.find(bound);
  GROVE_CHECK(found != bounds_.end(), "the bound of a status or an assignment is known");
  bounds_.erase(found);
}

void RankNodes::add(const message::Status& status, int sign) {
  counts_.expanded += sign * status.expanded;
  counts_.open += sign * status.open;
  if (status.live) children_with_nodes_ += sign;
  if (status.epoch == epoch_) children_of_this_epoch_ += sign;
  GROVE_CHECK(children_with_nodes_ >= 0 && children_with_nodes_ <= std::ssize(latest_) &&
                  children_of_this_epoch_ >= 0 && children_of_this_epoch_ <= std::ssize(latest_),
              "each child is counted at most once");
}

Cost RankNodes::bound() const {
  return *bounds_.begin();
}

Cost RankNodes::evicted_bound() const {
  return std::ranges::min(latest_, {}, &message::Status::evicted_bound).evicted_bound;
}

// The nodes of a child that has not handled the last Restart are unknown, so some may be live.
bool RankNodes::any() const {
  return children_with_nodes_ > 0 || assignments_in_transit_ > 0 ||
         children_of_this_epoch_ < std::ssize(latest_);
}

message::Status RankNodes::merged() const {
  message::Status all;
  all.bound = bound();
  all.live = children_with_nodes_ > 0 || assignments_in_transit_ > 0;
  all.open = counts_.open;
  all.expanded = counts_.expanded;
  all.epoch = epoch_;
  for (const message::Status& status : latest_) {
    all.evicted_bound = std::min(all.evicted_bound, status.evicted_bound);
    all.epoch = std::min(all.epoch, status.epoch);
    if (status.proven > all.proven)
      std::tie(all.proven, all.proven_by) = std::tie(status.proven, status.proven_by);
    if (all.stopped == StopReason::kNone) all.stopped = status.stopped;
  }
  GROVE_CHECK(all.bound <= all.evicted_bound, "the bound of a group covers its evicted nodes");
  return all;
}

void RankNodes::push(const NodePtr& root) {
  send(root->tree());
  assign({{record_of(*root)}, kInfiniteCost});
}

void RankNodes::assign(int child, message::AssignNodes nodes) {
  Cost bound = nodes.evicted_bound;
  for (const NodeRecord& node : nodes.nodes) bound = std::min(bound, node.bound);
  bounds_.insert(bound);
  in_transit_.at(static_cast<std::size_t>(child)).push_back(bound);
  ++assignments_in_transit_;
  children_.send(child, nodes);
}

void RankNodes::send(const Tree& tree) {
  if (broadcast_trees_.insert(tree.number).second)
    children_.broadcast(message::NewTree{tree.number, record_of(tree)});
}

int RankNodes::least_loaded() const {
  std::vector<int> all(latest_.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  return std::ranges::min(all, {}, [&](int child) {
    const auto place = static_cast<std::size_t>(child);
    return std::tuple(in_transit_[place].size(), latest_[place].open, child);
  });
}

void RankNodes::broadcast_restart(Cost proven) {
  children_.broadcast(message::Restart{proven});
  ++epoch_;
  children_of_this_epoch_ = 0;
}

void RankNodes::restart(std::span<const NodePtr> roots, Cost proven) {
  GROVE_CHECK(!any(), "a restart requires that no node is live on any rank");
  broadcast_restart(proven);
  for (const NodePtr& root : roots) push(root);
}

}  // namespace grove::detail
