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

// Matches ranks that have no node to expand, or only worse nodes than other ranks, with the
// children of a coordinator that have the best surplus. Its decisions affect only the running time,
// not the validity of the answer. One thread at a time.
class LoadBalancer {
 public:
  struct Transfer {
    int from = 0;            // the sending child
    int to = 0;              // the receiving rank, which is not below `from`
    std::int64_t nodes = 0;  // maximum number of nodes
    bool to_idle = false;
  };

  // `children`, by child: the child's own rank, or the ranks below it. Starts in the state in which
  // no rank has nodes.
  explicit LoadBalancer(const std::vector<std::vector<int>>& children, const Tuning& tuning = {});

  // Handles a new status from `child`.
  void update(int child, const message::Status& status);
  // Records that a transfer to `rank` has arrived.
  void arrived(int rank);
  // Returns the next transfer to order, or nullopt if no transfer is worthwhile. A rank to which a
  // transfer is in transit gets no second one.
  std::optional<Transfer> next();

  // Chooses the child that must send `nodes` nodes to a rank below another coordinator: the child
  // with the best surplus, or child 0 if no child has a surplus.
  int donor(std::int64_t nodes);
  // The surplus of all children at their best bounds, and their most urgent work requests. The
  // parent matches them with those of its other children.
  std::vector<message::Surplus> surplus() const;
  std::vector<message::WorkRequest> work_requests() const;

 private:
  using Offer = std::tuple<Cost, std::int64_t, int>;  // bound, -(nodes + next), child
  using Request = std::tuple<bool, Cost, int>;        // is busy, -best bound, rank

  struct View {
    std::vector<message::Surplus> surplus;  // ascending in bound, none empty
    std::vector<Request> requests;
  };

  View& view(int child) { return children_[static_cast<std::size_t>(child)]; }
  void offer(int child, std::vector<message::Surplus> surplus);
  void take(int child, std::int64_t nodes);

  const Tuning tuning_;
  std::vector<View> children_;
  std::set<Offer> offers_;
  std::map<Request, int> requests_;  // value: the child that the request came from
  std::set<int> awaiting_;           // ranks with a transfer in transit
};

}  // namespace grove::detail
