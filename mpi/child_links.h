// SPDX-License-Identifier: MIT
// Message links from a coordinator to its children (ranks or sub-coordinators).
#pragma once

#include <vector>

#include "mpi/hierarchy.h"
#include "mpi/messages.h"
#include "mpi/transport.h"

namespace grove::detail {

// Children are numbered from 0: ranks, or coordinators of the level below. One thread at a time.
class ChildLinks {
 public:
  // Links of the coordinator of `level` on the transport's rank. `transport` must outlive this.
  ChildLinks(Transport& transport, const Hierarchy& hierarchy, int level)
      : transport_(transport), hierarchy_(hierarchy), post_{transport.rank(), level} {}

  int count() const { return hierarchy_.children(post_); }
  // The child that is `rank` or is above it. `rank` must be below this coordinator.
  int with(int rank) const { return hierarchy_.child_with(post_, rank); }
  // For each child, the ranks that it is or that are below it.
  std::vector<std::vector<int>> ranks() const;
  bool include(int rank) const { return hierarchy_.is_below(post_, rank); }

  void tell(int child, const message::Message& message);
  void broadcast(const message::Message& message);
  // Sends each child the counts of the ranks that it is or that are below it.
  void send_message_counts(const message::MessageCounts& goodbye);

 private:
  Transport& transport_;
  const Hierarchy hierarchy_;
  const Endpoint post_;
};

}  // namespace grove::detail
