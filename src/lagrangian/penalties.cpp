// SPDX-License-Identifier: MIT
#include "lagrangian/penalties.h"

#include <algorithm>
#include <stdexcept>

#include "model/assert.h"

namespace grove::detail {

Penalties::Penalties(const World& world)
    : world_(world),
      first_move_(world.state_count() > 0 ? world.moves(0).data() : nullptr),
      pages_(kOnPage) {
  std::vector<std::vector<Arc>> to(static_cast<std::size_t>(world.place_count()));
  Arc arc = 0;
  for (Place place = 0; place < world.place_count(); ++place) {
    first_arc_.push_back(arc);
    to[place].push_back(arc++);
    for (const Place next : world.neighbors(place)) to[next].push_back(arc++);
  }
  arcs_ = static_cast<std::size_t>(arc);
  for (const auto& arcs : to) {
    for (const Arc a : arcs) arcs_to_.add(a);
    arcs_to_.end_row();
  }
  for (State state = 0; state < world.state_count(); ++state)
    for (const State next : world.moves(state))
      arc_of_move_.push_back(this->arc(world.place(state), world.place(next)));
}

Penalties::Arc Penalties::arc(Place from, Place to) const {
  if (from == to) return staying(from);
  const auto neighbors = world_.neighbors(from);
  const auto at = std::ranges::find(neighbors, to);
  GROVE_ASSERT(at != neighbors.end(), "an arc leads to a neighbour");
  return staying(from) + 1 + static_cast<Arc>(at - neighbors.begin());
}

void Penalties::add(Time arrival, Arc arc, Amount amount) {
  if (amount == 0) return;
  const std::size_t pages = (arcs_ + kOnPage - 1) / kOnPage;
  while (end() <= arrival) pages_of_time_.emplace_back(pages, 0);
  std::uint32_t& page = pages_of_time_[arrival][static_cast<std::size_t>(arc) / kOnPage];
  if (page == 0) {
    page = static_cast<std::uint32_t>(pages_.size() / kOnPage);
    pages_.resize(pages_.size() + kOnPage);
  }
  Amount& there = pages_[page * kOnPage + static_cast<std::size_t>(arc) % kOnPage];
  if (there + amount > kMaxPenalty) throw std::overflow_error("a penalty exceeds its maximum");
  there += amount;
  GROVE_ASSERT(there >= 0, "a penalty is not negative");
}

}  // namespace grove::detail
