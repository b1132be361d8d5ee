// SPDX-License-Identifier: MIT
#include "mpi/rank_nodes.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace grove::detail {

RankNodes::RankNodes(Transport& transport)
    : transport_(transport),
      latest_(static_cast<std::size_t>(transport.ranks())),
      under_way_(latest_.size()),
      ranks_of_this_era_(transport.ranks()) {
  for (std::size_t rank = 0; rank < latest_.size(); ++rank) bounds_.insert(kInfiniteCost);
}

// A rank obeys in the order in which it is told: its status covers the first roots that it was
// sent.
void RankNodes::update(int rank, message::Status status) {
  const auto place = static_cast<std::size_t>(rank);
  message::Status& latest = latest_[place];
  std::deque<Cost>& sent = under_way_[place];
  const std::int64_t arrived = status.entrusted - latest.entrusted;
  if (arrived < 0 || arrived > std::ssize(sent) || status.era < latest.era || status.era > era_)
    throw std::invalid_argument("a status of a rank that does not fit what it was told");
  bounds_.insert(status.bound);
  bounds_.erase(bounds_.find(latest.bound));
  for (std::int64_t i = 0; i < arrived; ++i) {
    bounds_.erase(bounds_.find(sent.front()));
    sent.pop_front();
    --entrusted_under_way_;
  }
  add(latest, -1);
  add(status, 1);
  latest = std::move(status);
}

void RankNodes::add(const message::Status& status, int sign) {
  counts_.expanded += sign * status.expanded;
  counts_.open += sign * status.open;
  if (status.live > 0) ranks_with_nodes_ += sign;
  if (status.era == era_) ranks_of_this_era_ += sign;
}

RankSurvey RankNodes::survey(int rank) const {
  const message::Status& latest = latest_[static_cast<std::size_t>(rank)];
  const auto bound = latest.live > 0 ? std::optional(latest.bound) : std::nullopt;
  return {latest.expanded, latest.open, bound, {}};
}

Cost RankNodes::bound() const {
  return *bounds_.begin();
}

Cost RankNodes::evicted_bound() const {
  return std::ranges::min(latest_, {}, &message::Status::evicted_bound).evicted_bound;
}

// What a rank that has yet to hear of a new beginning holds is not known.
bool RankNodes::any() const {
  return ranks_with_nodes_ > 0 || entrusted_under_way_ > 0 ||
         ranks_of_this_era_ < std::ssize(latest_);
}

void RankNodes::push(const NodePtr& root) {
  tell(root->tree());
  entrust(idlest(), {record_of(*root)});
}

void RankNodes::entrust(int rank, std::vector<NodeRecord> nodes, Cost evicted_bound) {
  Cost bound = evicted_bound;
  for (const NodeRecord& node : nodes) bound = std::min(bound, node.bound);
  bounds_.insert(bound);
  under_way_[static_cast<std::size_t>(rank)].push_back(bound);
  ++entrusted_under_way_;
  transport_.send(rank, bytes_of(message::Entrust{std::move(nodes), evicted_bound}));
}

void RankNodes::tell(const Tree& tree) {
  if (told_.insert(tree.number).second)
    tell_all(transport_, message::NewTree{tree.number, record_of(tree)});
}

int RankNodes::idlest() const {
  std::vector<int> ranks(latest_.size());
  for (std::size_t i = 0; i < ranks.size(); ++i) ranks[i] = static_cast<int>(i);
  return std::ranges::min(ranks, {}, [&](int rank) {
    const auto place = static_cast<std::size_t>(rank);
    return std::tuple(under_way_[place].size(), latest_[place].open, rank);
  });
}

void RankNodes::restart(std::span<const NodePtr> roots, Cost proven) {
  tell_all(transport_, message::BeginAnew{proven});
  ++era_;
  ranks_of_this_era_ = 0;
  for (const NodePtr& root : roots) push(root);
}

}  // namespace grove::detail
