// SPDX-License-Identifier: MIT
// Two agents that meet head on in a corridor conflict at one place, but barring one of them from
// there moves the conflict along by a step: CBS tries all places and times before it finds that one
// agent must wait until the other is through (corridor symmetry: Li et al., ICAPS 2020). Corridor
// reasoning with bans on the corridor's ends would forbid an agent with several goals to come back
// later on another errand. What must be forbidden is one *traversal*.
//
// A chain has k moves from end to end, and its inner places have two neighbors each. An agent
// *traverses* it when it moves from one end into it and leaves it for the other end without having
// left it in between; p is the time at which it arrives at that other end.
//
// *Claim: two traversals in opposite directions that arrive at p and q with |p - q| <= k collide.*
// Let a's last time on the end where it enters be s <= p - k, b's r <= q - k. Both are on the chain
// or its ends in I = [max(s, r), min(p, q)], which is not empty: s <= p - k <= q and r <= q - k <=
// p. Number the places 0 .. k along a's way. When I begins, a is at 0 or b at k; when it ends, a is
// at k or b at 0. So a's place is first at most, and at last at least, b's. Per step the difference
// grows by 2 at most: it is 0 at some time (one place), or jumps from -1 to 1 (a swap).
//
// So of all pairs of times p' in [p, q + k], q' in [q, p + k] none is free of collision: p' - q' <=
// k and q' - p' <= k. Every conflict-free plan therefore obeys one of
//
//   a does not arrive by traversal in [p, q + k]    |    b does not in [q, p + k].
//
// Turning round inside, and starting inside, are no traversals and stay allowed; nothing is said
// about the order of visits or about other passages. Both paths of the conflict break their side.
// "Who passes first" as a statement about time alone, without labels.
#include <algorithm>
#include <array>

#include "conflicts/symmetry_reasoning.h"

namespace grove::detail {
namespace {

// An agent's way through a chain.
struct Traversal {
  bool forward;  // from the front to the back
  Time arrival;  // at the end
  Place end;     // where it leaves
  Place last;    // the inner place before
};

bool is_inner(const Corridors& corridors, int chain, Place place) {
  return corridors.corridor_of(place) == chain;
}

// The traversal of `chain` during which the path is inside at `time`.
std::optional<Traversal> traversal_at(const World& world, const Corridors& corridors, int chain,
                                      const Path& path, Time time) {
  const auto place = [&](Time t) { return world.place(path[t]); };
  const auto inside = [&](Time t) { return is_inner(corridors, chain, place(t)); };
  const auto length = static_cast<Time>(path.size());
  if (time < 0 || time >= length || !inside(time)) return std::nullopt;
  Time entry = time;  // the first time inside
  while (entry > 0 && inside(entry - 1)) --entry;
  Time arrival = time;
  while (arrival < length && inside(arrival)) ++arrival;
  if (entry == 0 || arrival == length) return std::nullopt;

  const auto places = corridors.places(chain);
  const auto at_front = [&](Place end, Place inner) {
    return end == places.front() && inner == places[1];
  };
  const bool from_front = at_front(place(entry - 1), place(entry));
  const bool to_front = at_front(place(arrival), place(arrival - 1));
  if (from_front == to_front) return std::nullopt;
  return Traversal{from_front, arrival, place(arrival), place(arrival - 1)};
}

// The traversal that the path is in at `time`, or ends or begins then.
std::optional<Traversal> traversal_near(const World& world, const Corridors& corridors, int chain,
                                        const Path& path, Time time) {
  for (const Time t : {time, time - 1, time + 1})
    if (const auto traversal = traversal_at(world, corridors, chain, path, t)) return traversal;
  return std::nullopt;
}

std::optional<Split> split_on(const Conflict& conflict, std::span<const Path> paths,
                              const World& world, const Corridors& corridors, int chain) {
  const auto a = traversal_near(world, corridors, chain, paths[conflict.first], conflict.time);
  if (!a) return std::nullopt;
  const auto b = traversal_near(world, corridors, chain, paths[conflict.second], conflict.time);
  if (!b || a->forward == b->forward) return std::nullopt;
  const auto moves = static_cast<Time>(corridors.places(chain).size()) - 1;
  const Time a_last = b->arrival + moves;
  const Time b_last = a->arrival + moves;
  if (a->arrival > a_last || b->arrival > b_last) return std::nullopt;
  const auto barred = [](const Traversal& t, Time last) {
    return Constraint{t.end, t.last, t.arrival, last, ConstraintKind::kNoTraversal};
  };
  return Split{{{conflict.first, barred(*a, a_last)}, {conflict.second, barred(*b, b_last)}}};
}

}  // namespace

std::optional<Split> corridor_split(const Conflict& conflict, std::span<const Path> paths,
                                    const World& world, const Corridors& corridors) {
  if (conflict.is_following()) return std::nullopt;
  // Where both are, or - when they meet on an end - where one of them comes from.
  const std::array<Place, 4> places{
      conflict.cell, conflict.is_swap() ? conflict.from : conflict.cell,
      place_at(world, paths[conflict.first], std::max(0, conflict.time - 1)),
      place_at(world, paths[conflict.second], std::max(0, conflict.time - 1))};
  for (Place place : places) {
    const int chain = corridors.corridor_of(place);
    if (chain == Corridors::kNoCorridor) continue;
    if (const auto split = split_on(conflict, paths, world, corridors, chain)) return split;
  }
  return std::nullopt;
}

}  // namespace grove::detail
