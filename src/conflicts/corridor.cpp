// SPDX-License-Identifier: MIT
// Corridor reasoning (corridor symmetry: Li et al., ICAPS 2020), for agents with several goals.
//
// *Problem.* Two agents that meet head on in a corridor conflict at one place. If one of them is
// barred from this place, the conflict moves along the corridor by a step: CBS tries all places and
// times before it finds that one agent must wait until the other is through. Range constraints on
// the ends of the corridor, as in Li et al., would forbid an agent with several goals to return
// later for a different goal. Only one *traversal* must be forbidden.
//
// *Definitions.* A corridor has k moves from end to end, and its inner places have two neighbours
// each. An agent *traverses* it when it moves from one end into it and leaves it at the other end
// without having left it in between. It arrives at that other end at time p.
//
// *Claim: two traversals in opposite directions that arrive at p and q with |p - q| <= k collide.*
// *Proof.* Let s <= p - k be a's last time on the end where it enters, and let r <= q - k be the
// same for b. Both agents are on the corridor or its ends in I = [max(s, r), min(p, q)]. I is not
// empty, because s <= p - k <= q and r <= q - k <= p. Number the places 0 .. k in a's direction. At
// the beginning of I, a is at 0 or b at k; at its end, a is at k or b at 0. So a's place is at most
// b's at the beginning and at least b's at the end. The difference of the places grows by at most 2
// per step. So it is 0 at some time (a vertex conflict), or jumps from -1 to 1 (an edge conflict).
//
// *Consequence.* No pair of times p' in [p, q + k], q' in [q, p + k] is free of collision, because
// p' - q' <= k and q' - p' <= k. So every conflict-free plan satisfies one of
//
//   a does not arrive by traversal in [p, q + k]    |    b does not in [q, p + k].
//
// Turning round inside and starting inside are not traversals and stay allowed. The split says
// nothing about the order of visits or about other passages. Each of the two conflicting paths
// violates the constraint on its agent. The split expresses "which agent passes first" by times
// only.
#include <algorithm>
#include <array>

#include "conflicts/symmetry_reasoning.h"
#include "model/assert.h"
#include "planning/constraint.h"

namespace grove::detail {
namespace {

// An agent's passage through a corridor.
struct Traversal {
  bool forward;  // from the front to the back
  Time arrival;  // at the far end
  Place end;     // the end where it leaves
  Place last;    // the inner place before `end`
};

bool is_inner(const Corridors& corridors, int corridor, Place place) {
  return corridors.corridor_of(place) == corridor;
}

// The traversal of `corridor` during which the path is inside at `time`. Returns nullopt if there
// is none.
std::optional<Traversal> traversal_at(const World& world, const Corridors& corridors, int corridor,
                                      const Path& path, Time time) {
  const auto place = [&](Time t) { return world.place(path[t]); };
  const auto inside = [&](Time t) { return is_inner(corridors, corridor, place(t)); };
  const auto length = static_cast<Time>(path.size());
  if (time < 0 || time >= length || !inside(time)) return std::nullopt;
  Time entry = time;  // the first time inside
  while (entry > 0 && inside(entry - 1)) --entry;
  Time arrival = time;
  while (arrival < length && inside(arrival)) ++arrival;
  if (entry == 0 || arrival == length) return std::nullopt;

  const auto places = corridors.places(corridor);
  const auto at_front = [&](Place end, Place inner) {
    return end == places.front() && inner == places[1];
  };
  const bool from_front = at_front(place(entry - 1), place(entry));
  const bool to_front = at_front(place(arrival), place(arrival - 1));
  if (from_front == to_front) return std::nullopt;
  return Traversal{from_front, arrival, place(arrival), place(arrival - 1)};
}

// The traversal that contains `time`, or starts or ends then. Returns nullopt if there is none.
std::optional<Traversal> traversal_near(const World& world, const Corridors& corridors,
                                        int corridor, const Path& path, Time time) {
  for (const Time t : {time, time - 1, time + 1})
    if (const auto traversal = traversal_at(world, corridors, corridor, path, t)) return traversal;
  return std::nullopt;
}

std::optional<Split> split_on(const Conflict& conflict, std::span<const Path> paths,
                              const World& world, const Corridors& corridors, int corridor) {
  const auto a = traversal_near(world, corridors, corridor, paths[conflict.first], conflict.time);
  if (!a) return std::nullopt;
  const auto b = traversal_near(world, corridors, corridor, paths[conflict.second], conflict.time);
  if (!b || a->forward == b->forward) return std::nullopt;
  const auto moves = static_cast<Time>(corridors.places(corridor).size()) - 1;
  const Time a_last = b->arrival + moves;
  const Time b_last = a->arrival + moves;
  if (a->arrival > a_last || b->arrival > b_last) return std::nullopt;
  const auto barred = [](const Traversal& t, Time last) {
    return Constraint{t.end, t.last, t.arrival, last, ConstraintKind::kNoTraversal};
  };
  const Split split{{{conflict.first, barred(*a, a_last)}, {conflict.second, barred(*b, b_last)}}};
  GROVE_ASSERT(!satisfies(world, paths[conflict.first], split[0].constraint, corridors) &&
                   !satisfies(world, paths[conflict.second], split[1].constraint, corridors),
               "both paths violate the corridor split of their conflict");
  return split;
}

}  // namespace

std::optional<Split> corridor_split(const Conflict& conflict, std::span<const Path> paths,
                                    const World& world, const Corridors& corridors) {
  if (conflict.is_following()) return std::nullopt;
  // The places of both agents or, if they meet on an end, the places from which they came.
  const std::array<Place, 4> places{
      conflict.cell, conflict.is_swap() ? conflict.from : conflict.cell,
      place_at(world, paths[conflict.first], std::max(0, conflict.time - 1)),
      place_at(world, paths[conflict.second], std::max(0, conflict.time - 1))};
  for (Place place : places) {
    const int corridor = corridors.corridor_of(place);
    if (corridor == Corridors::kNoCorridor) continue;
    if (const auto split = split_on(conflict, paths, world, corridors, corridor)) return split;
  }
  return std::nullopt;
}

}  // namespace grove::detail
