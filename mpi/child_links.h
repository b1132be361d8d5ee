// SPDX-License-Identifier: MIT
// Those who answer to one coordinator, as it speaks to them.
#pragma once

#include <vector>

#include "mpi/hierarchy.h"
#include "mpi/messages.h"
#include "mpi/transport.h"

namespace grove::detail {

// Ranks, or coordinators of the level below; counted from 0. Of one thread.
class ChildLinks {
 public:
  // Of the coordinator of this level on the transport's rank. `transport` must outlive this.
  ChildLinks(Transport& transport, const Hierarchy& hierarchy, int level)
      : transport_(transport), hierarchy_(hierarchy), post_{transport.rank(), level} {}

  int count() const { return hierarchy_.children(post_); }
  // The one that this rank is, or is below; of a rank that is below all of them.
  int with(int rank) const { return hierarchy_.child_with(post_, rank); }
  // The ranks that each is, or that are below it.
  std::vector<std::vector<int>> ranks() const;
  bool include(int rank) const { return hierarchy_.is_below(post_, rank); }

  void tell(int child, const message::Message& message);
  void broadcast(const message::Message& message);
  // Each its part of this.
  void send_message_counts(const message::MessageCounts& goodbye);

 private:
  Transport& transport_;
  const Hierarchy hierarchy_;
  const Endpoint post_;
};

}  // namespace grove::detail
