// SPDX-License-Identifier: MIT
#include "mpi/learned_bound_exchange.h"

#include <string>
#include <utility>

namespace grove::detail {

std::vector<BoundBroadcast::OutgoingMessage> LearnedBoundExchange::take_messages(double now) {
  if (!broadcast_.is_on()) return {};
  const auto cache = memory_.cache();
  for (const LearnedBound& bound : learned_bounds_of(cache->take_new_entries(), *cache, trees_))
    broadcast_.add(bound);
  auto messages = broadcast_.due(now);
  for (const auto& [rank, bounds] : messages) sent_ += std::ssize(bounds.facts);
  return messages;
}

// Forwards the bounds even if this rank's cache has no room for them, because other ranks get them
// only through this rank.
void LearnedBoundExchange::receive(message::LearnedBounds& bounds, bool ended) {
  const auto cache = memory_.cache();
  const bool has_room = memory_.has_room_for_facts();
  for (std::string& bytes : bounds.facts) {
    LearnedBound bound = message::unpacked(bytes);
    if (!ended) broadcast_.add(bound.utility(), std::move(bytes), bounds.reach);
    if (has_room) merge(std::move(bound), trees_, *cache);
  }
}

}  // namespace grove::detail
