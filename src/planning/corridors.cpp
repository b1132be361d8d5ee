// SPDX-License-Identifier: MIT
#include "planning/corridors.h"

#include <algorithm>

#include "model/assert.h"

namespace grove::detail {
namespace {

bool is_inner(const World& world, Place place) {
  return world.neighbors(place).size() == 2;
}

// Follows the row from `next` away from its neighbor `before`, and appends the places up to the end
// of the row. Returns false if the row is a ring; then the appended places are those of the ring
// without `before`.
bool walk_to_end(const World& world, Place before, Place next, std::vector<Place>& places) {
  const Place origin = before;
  while (next != origin) {
    places.push_back(next);
    if (!is_inner(world, next)) return true;
    const auto ways = world.neighbors(next);
    const Place after = ways[0] == before ? ways[1] : ways[0];
    before = next;
    next = after;
  }
  return false;
}

}  // namespace

Corridors::Corridors(const World& world)
    : corridor_of_(world.place_count(), kNoCorridor), position_(world.place_count(), 0) {
  for (Place place = 0; place < world.place_count(); ++place)
    if (is_inner(world, place) && position_[place] == 0) add_corridor_through(world, place);
}

void Corridors::add_corridor_through(const World& world, Place inner) {
  const auto begin = static_cast<std::ptrdiff_t>(places_.size());
  const auto ways = world.neighbors(inner);
  const bool ends = walk_to_end(world, inner, ways[0], places_);
  if (!ends) {  // a ring: places_ holds all its places except this one
    for (auto ring = places_.begin() + begin; ring != places_.end(); ++ring)
      position_[*ring] = kSeen;
    position_[inner] = kSeen;
    places_.erase(places_.begin() + begin, places_.end());
    return;
  }
  std::reverse(places_.begin() + begin, places_.end());
  places_.push_back(inner);
  walk_to_end(world, inner, ways[1], places_);
  first_.push_back(static_cast<std::int32_t>(places_.size()));
  number_inner_places(count() - 1);
}

void Corridors::number_inner_places(int corridor) {
  const auto row = places(corridor);
  GROVE_CHECK(row.size() >= 3, "a corridor has two ends and an inner place");
  for (std::size_t i = 1; i + 1 < row.size(); ++i) {
    GROVE_CHECK(corridor_of_[row[i]] == kNoCorridor && position_[row[i]] == 0,
                "a place is inside one corridor");
    corridor_of_[row[i]] = corridor;
    position_[row[i]] = static_cast<std::int32_t>(i);
  }
}

}  // namespace grove::detail
