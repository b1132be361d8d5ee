// SPDX-License-Identifier: MIT
// Load balancing: decides which child sends nodes to which rank.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "model/tuning.h"
#include "mpi/messages.h"

namespace grove::detail {

// Matches ranks that have no node to expand, or only worse nodes than others, with the children of
// a coordinator that have the largest surplus. It affects only the running time, not the validity
// of the answer. One thread at a time.
class LoadBalancer {
 public:
  struct Transfer {
    int from = 0;            // the child
    int to = 0;              // the receiving rank, which is not below `from`
    std::int64_t nodes = 0;  // at most
    bool to_idle = false;
  };

  // `children`: for each child, the ranks that it is or that are below it. No rank has nodes yet.
  explicit LoadBalancer(const std::vector<std::vector<int>>& children, const Tuning& tuning = {});

  // Handles a new status of `child`.
  void heard(int child, const message::Status& status);
  // A transfer to `rank` has arrived.
  void arrived(int rank);
  // The next transfer to order. A rank with a transfer in transit gets no other. Returns nullopt if
  // no transfer is worthwhile.
  std::optional<Transfer> next();

  // The child that has to send `nodes` nodes to a rank below another coordinator: the one with the
  // best surplus, or child 0 if none has a surplus.
  int donor(std::int64_t nodes);
  // The surplus of all children at their best bounds, and the most urgent work requests: for the
  // parent, which matches them with those of other children.
  std::vector<message::Surplus> surplus() const;
  std::vector<message::WorkRequest> work_requests() const;

 private:
  using Offer = std::tuple<Cost, std::int64_t, int>;  // bound, -(nodes + next), child
  using Request = std::tuple<bool, Cost, int>;        // is busy, -best bound, rank

  struct View {
    std::vector<message::Surplus> surplus;  // ascending in bound, none empty
    std::vector<Request> wishes;
  };

  View& view(int child) { return children_[static_cast<std::size_t>(child)]; }
  void offer(int child, std::vector<message::Surplus> surplus);
  void take(int child, std::int64_t nodes);

  const Tuning tuning_;
  std::vector<View> children_;
  std::set<Offer> offers_;
  std::map<Request, int> wishes_;  // value: the child of the request
  std::set<int> awaiting_;         // ranks with a transfer in transit
};

}  // namespace grove::detail
