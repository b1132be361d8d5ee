// SPDX-License-Identifier: MIT
// Load balancing policy.
//
// *Idle ranks* come first. They get nodes whatever the bounds of the nodes, because these may have
// to be expanded, and an idle rank contributes nothing.
//
// *Busy ranks.* A rank whose best node is worse than the surplus of another child receives nodes,
// too, so that all ranks expand nodes near the lower bound. With omega = 0 all nodes below the
// optimum must be expanded in any case, so such a transfer gains little. Therefore it is made only
// for at least min_surplus_nodes nodes.
//
// *Levels.* A coordinator matches requests with the surplus of other children only. Requests and
// surplus within one child are matched by that child, those that remain by the parent.
#include "mpi/load_balancer.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <ranges>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::size_t kMaxForwardedRequests = 16;
constexpr std::size_t kMaxForwardedLevels = 4;

std::int64_t all_of(const message::Surplus& surplus) {
  return surplus.nodes + surplus.next;
}

}  // namespace

LoadBalancer::LoadBalancer(const std::vector<std::vector<int>>& children, const Tuning& tuning)
    : tuning_(tuning), children_(children.size()) {
  for (std::size_t child = 0; child < children.size(); ++child) {
    message::Status idle;
    for (const int rank : children[child] | std::views::take(kMaxForwardedRequests))
      idle.work_requests.push_back({rank, true, kInfiniteCost});
    update(static_cast<int>(child), idle);
  }
}

void LoadBalancer::update(int child, const message::Status& status) {
  View& at = view(child);
  for (const Request& request : at.requests) {
    const std::size_t erased = requests_.erase(request);
    GROVE_CHECK(erased == 1, "each request of a child is listed once");
  }
  at.requests.clear();
  for (const message::WorkRequest& want : status.work_requests) {
    const Request& request = at.requests.emplace_back(!want.idle, -want.best, want.rank);
    requests_[request] = child;
  }
  GROVE_ASSERT(
      requests_.size() == std::accumulate(children_.begin(), children_.end(), std::size_t{0},
                                          [](std::size_t sum, const View& view) {
                                            return sum + view.requests.size();
                                          }),
      "the list holds the requests of all children");
  offer(child, status.surplus);
}

void LoadBalancer::arrived(int rank) {
  awaiting_.erase(rank);
}

// Replaces the surplus of `child`, and its offer: the best entry of the surplus.
void LoadBalancer::offer(int child, std::vector<message::Surplus> surplus) {
  View& at = view(child);
  const auto best = [&] { return Offer(at.surplus[0].bound, -all_of(at.surplus[0]), child); };
  const std::size_t erased = at.surplus.empty() ? 0 : offers_.erase(best());
  GROVE_CHECK(erased == (at.surplus.empty() ? 0 : 1), "the best surplus of a child is on offer");
  at.surplus = std::move(surplus);
  GROVE_CHECK(std::ranges::adjacent_find(at.surplus, std::greater_equal<>(),
                                         &message::Surplus::bound) == at.surplus.end(),
              "a surplus is in ascending order of bounds");
  GROVE_CHECK(std::ranges::all_of(at.surplus,
                                  [](const message::Surplus& each) {
                                    return each.nodes >= 0 && each.next >= 0 && all_of(each) > 0;
                                  }),
              "a surplus has no entry without nodes");
  if (!at.surplus.empty()) offers_.insert(best());
}

void LoadBalancer::take(int child, std::int64_t nodes) {
  std::vector<message::Surplus> left = view(child).surplus;
  message::Surplus& best = left[0];
  const std::int64_t few = std::min(nodes, best.nodes);
  best.nodes -= few;
  best.next -= std::min(nodes - few, best.next);
  if (all_of(best) == 0) left.erase(left.begin());
  offer(child, std::move(left));
}

// The requests are sorted by urgency. If no transfer is worthwhile for a request, hardly any is for
// the requests after it (only one from the child of the former), so the loop ends there.
std::optional<LoadBalancer::Transfer> LoadBalancer::next() {
  for (const auto& [request, child] : requests_) {
    const auto& [busy, minus_best, to] = request;
    if (awaiting_.contains(to)) continue;
    auto best = offers_.begin();
    if (best != offers_.end() && std::get<int>(*best) == child) ++best;
    if (best == offers_.end()) {
      if (offers_.empty()) break;
      continue;
    }
    const int from = std::get<int>(*best);
    const message::Surplus& surplus = view(from).surplus[0];
    const bool helps = -minus_best == kInfiniteCost ||
                       (-minus_best > surplus.bound && surplus.nodes >= tuning_.min_surplus_nodes);
    if (!helps) break;
    const std::int64_t nodes = busy ? surplus.nodes : all_of(surplus);
    if (nodes == 0) continue;
    const Transfer transfer{from, to, std::min(nodes, tuning_.transfer_nodes), !busy};
    GROVE_CHECK(from != child && transfer.nodes > 0,
                "a transfer moves one node or more between two different children");
    take(from, transfer.nodes);
    const bool is_first = awaiting_.insert(to).second;
    GROVE_CHECK(is_first, "a rank awaits at most one transfer");
    return transfer;
  }
  return std::nullopt;
}

int LoadBalancer::donor(std::int64_t nodes) {
  if (offers_.empty()) return 0;
  const int child = std::get<int>(*offers_.begin());
  take(child, nodes);
  return child;
}

std::vector<message::Surplus> LoadBalancer::surplus() const {
  std::map<Cost, message::Surplus> sums;
  for (const View& child : children_)
    for (const message::Surplus& surplus : child.surplus) {
      message::Surplus& sum = sums[surplus.bound];
      sum = {surplus.bound, sum.nodes + surplus.nodes, sum.next + surplus.next};
    }
  std::vector<message::Surplus> best;
  for (const auto& [bound, sum] : sums | std::views::take(kMaxForwardedLevels)) best.push_back(sum);
  return best;
}

std::vector<message::WorkRequest> LoadBalancer::work_requests() const {
  std::vector<message::WorkRequest> work_requests;
  for (const auto& [request, child] : requests_) {
    const auto& [busy, minus_best, rank] = request;
    if (work_requests.size() == kMaxForwardedRequests) break;
    if (!awaiting_.contains(rank)) work_requests.push_back({rank, !busy, -minus_best});
  }
  return work_requests;
}

}  // namespace grove::detail
