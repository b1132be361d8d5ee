// SPDX-License-Identifier: MIT
// Exchange of learned bounds between the cache of this rank and other ranks.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/search_memory.h"
#include "mpi/bound_broadcast.h"
#include "search/learned_bounds.h"
#include "search/tree_record.h"

namespace grove::detail {

// Adds new bounds of the cache to the broadcast, and received bounds to the cache. One thread at a
// time.
class LearnedBoundExchange {
 public:
  // `memory` must outlive this object. `rate`: see BoundBroadcast.
  LearnedBoundExchange(int rank, int ranks, double rate, SearchMemory& memory)
      : memory_(memory), broadcast_(rank, ranks, rate) {}

  // Adds a tree to which bounds can refer.
  void add_tree(const Tree& tree) { trees_.add(tree); }
  // Returns the messages to send now. `now`: seconds since the start of the run.
  std::vector<BoundBroadcast::OutgoingMessage> take_messages(double now);
  // Adds received bounds to the cache, and forwards them unless `ended`.
  void receive(message::LearnedBounds& bounds, bool ended);
  // See BoundBroadcast.
  double next_send_time() const { return broadcast_.next_send_time(); }
  // Number of bounds sent so far, counted once per receiving rank.
  std::int64_t sent() const { return sent_; }

 private:
  SearchMemory& memory_;
  TreeIndex trees_;
  BoundBroadcast broadcast_;
  std::int64_t sent_ = 0;
};

}  // namespace grove::detail
