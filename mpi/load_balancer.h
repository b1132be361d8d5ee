// SPDX-License-Identifier: MIT
// Who gives nodes to whom.
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

// Matches ranks that have nothing to expand, or nothing as good as others, with children of a
// coordinator that have most to spare. Decides nothing that an answer depends on. Of one thread.
class LoadBalancer {
 public:
  struct Transfer {
    int from = 0;            // the child
    int to = 0;              // the rank, which is not there
    std::int64_t nodes = 0;  // at most
    bool to_idle = false;
  };

  // The ranks that each child is, or that are below it; nobody has nodes yet.
  explicit LoadBalancer(const std::vector<std::vector<int>>& children, const Tuning& tuning = {});

  // A child's new status.
  void heard(int child, const message::Status& status);
  // A gift to this rank has arrived.
  void arrived(int rank);
  // What to order next. Until it has arrived the receiver is given nothing else.
  std::optional<Transfer> next();

  // The child that is to give so many nodes to somebody elsewhere: the one that can spare the best,
  // or any.
  int donor(std::int64_t nodes);
  // What all children together can spare of their best bounds, and who of them needs nodes most:
  // for a superior, to match with those of others.
  std::vector<message::Surplus> surplus() const;
  std::vector<message::WorkRequest> work_requests() const;

 private:
  using Offer = std::tuple<Cost, std::int64_t, int>;  // bound, minus all nodes, child
  using Request = std::tuple<bool, Cost, int>;        // has nodes in hand, minus best bound, rank

  struct View {
    std::vector<message::Surplus> surplus;  // ascending in bound, none of them empty
    std::vector<Request> wishes;
  };

  View& view(int child) { return children_[static_cast<std::size_t>(child)]; }
  void offer(int child, std::vector<message::Surplus> surplus);
  void take(int child, std::int64_t nodes);

  const Tuning tuning_;
  std::vector<View> children_;
  std::set<Offer> offers_;
  std::map<Request, int> wishes_;  // whose child they are
  std::set<int> awaiting_;         // ranks, a gift
};

}  // namespace grove::detail
