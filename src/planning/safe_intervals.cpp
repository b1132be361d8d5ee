// SPDX-License-Identifier: MIT
#include "planning/safe_intervals.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "model/assert.h"

namespace grove::detail {

SafeIntervals::SafeIntervals(const World& world)
    : world_(world),
      states_(world.state_count()),
      states_are_places_(world.states_are_places()),
      slot_limit_(states_),
      group_of_(world.place_count(), kNoGroup) {}

void SafeIntervals::assign(std::span<const Constraint> constraints) {
  forget();
  for (const Constraint& c : constraints) check(c);
  for (const Constraint& c : constraints) keep(c);
  std::ranges::sort(bars_, [](const Bar& a, const Bar& b) {
    return std::tuple(a.place, a.kind, a.begin) < std::tuple(b.place, b.kind, b.begin);
  });
  group_inner_places();
  group_bars();
  for (Group& group : groups_) add_slots(group);
  slot_limit_ = slot_count();
}

void SafeIntervals::assign(const ReservationTable& reservations) {
  forget();
  reservations_ = &reservations;
  // k >= 1 stays on a place leave at most k + 1 <= 2 k intervals for each state.
  slot_limit_ =
      states_ + static_cast<int>(2 * reservations.count()) * world_.max_states_on_a_place();
}

void SafeIntervals::add_reserved_place(Place place) {
  const std::span<const ReservationTable::Stay> stays = reservations_->stays(place);
  const Time margin = reservations_->margin();
  if (stays.empty()) return;
  Group g{.place = place};
  g.first_slot = slot_count();
  world_.for_each_state(place, [&](State state) {
    Time safe_from = 0;
    Place left_for = kNoPlace;
    for (const ReservationTable::Stay& stay : stays) {
      const Time until = stay.first - 1 - margin;
      if (safe_from <= until) add({state, safe_from, until, until, kFree, false, left_for});
      safe_from = stay.last + 1 + margin;
      left_for = stay.next;
    }
    if (safe_from < kNever) add({state, safe_from, kNever, kNever, kFree, true, left_for});
  });
  GROVE_ASSERT((slot_count() - g.first_slot) % world_.states_on(place) == 0,
               "the states on a place have equally many slots");
  GROVE_ASSERT(slot_count() <= slot_limit_, "the number of slots is within its limit");
  g.slots = (slot_count() - g.first_slot) / world_.states_on(place);
  group_of_[place] = static_cast<std::int32_t>(groups_.size());
  groups_.push_back(g);
}

void SafeIntervals::forget() {
  for (const Group& group : groups_) group_of_[group.place] = kNoGroup;
  reservations_ = nullptr;
  groups_.clear();
  intervals_.clear();
  bars_.clear();
  restricted_corridors_.clear();
  only_rest_ = kNoPlace;
  latest_rest_ = kNever;
}

void SafeIntervals::check(const Constraint& c) {
  const auto is_place = [this](Place p) { return p >= 0 && p < world_.place_count(); };
  const bool has_from = c.is_move() || c.kind == ConstraintKind::kNoTraversal;
  if (!is_place(c.cell) || (has_from && (!is_place(c.from) || c.from == c.cell)))
    throw std::invalid_argument("a constraint must forbid a place or a move between two places");
  if (is_about_sequence(c))
    throw std::invalid_argument("a sequence constraint does not apply to paths");
  if (c.kind != ConstraintKind::kNoTraversal) return;
  if (!corridors_) corridors_.emplace(world_);
  if (!leaves_at_front(c) && !leaves_at_back(c))
    throw std::invalid_argument("a traversal must leave a corridor by one of its ends");
}

bool SafeIntervals::leaves_at_front(const Constraint& c) const {
  const int corridor = corridors_->corridor_of(c.from);
  return corridor != Corridors::kNoCorridor && corridors_->position(c.from) == 1 &&
         corridors_->places(corridor).front() == c.cell;
}

bool SafeIntervals::leaves_at_back(const Constraint& c) const {
  const int corridor = corridors_->corridor_of(c.from);
  if (corridor == Corridors::kNoCorridor) return false;
  const auto places = corridors_->places(corridor);
  return places[places.size() - 2] == c.from && places.back() == c.cell;
}

void SafeIntervals::keep(const Constraint& c) {
  const bool is_ever = c.end >= std::max(c.begin, 0);
  switch (c.kind) {
    case ConstraintKind::kVertexOrEdge:
      if (is_ever) keep_bar(c);
      break;
    case ConstraintKind::kNoRestBy:
      if (c.end >= 0) bars_.push_back({c.cell, kNoPlace, 0, c.end, Bar::Kind::kRest, kFree});
      break;
    case ConstraintKind::kRestBy:
      keep_rest_by(c);
      break;
    case ConstraintKind::kNoTraversal:
      if (is_ever) keep_traversal(c);
      break;
    case ConstraintKind::kStopIs:
    case ConstraintKind::kStopIsNot:
      break;  // check() refuses constraints on the sequence
  }
}

void SafeIntervals::keep_bar(const Constraint& c) {
  const Bar::Kind kind = c.is_move() ? Bar::Kind::kMove : Bar::Kind::kPlace;
  bars_.push_back({c.cell, c.from, c.begin, c.end, kind, kFree});
}

void SafeIntervals::keep_rest_by(const Constraint& c) {
  only_rest_ = only_rest_ == kNoPlace || only_rest_ == c.cell ? c.cell : kNowhere;
  latest_rest_ = std::min(latest_rest_, c.end);
  // This bars nothing, but the place needs slots of its own.
  if (!states_are_places_) bars_.push_back({c.cell, kNoPlace, 0, -1, Bar::Kind::kRest, kFree});
}

void SafeIntervals::keep_traversal(const Constraint& c) {
  RestrictedCorridor& used = restricted_corridor(corridors_->corridor_of(c.from));
  const bool at_back = leaves_at_back(c);
  (at_back ? used.from_front = kFromFront : used.from_back = kFromBack);
  const std::uint8_t barred = at_back ? kFromFront : kFromBack;
  bars_.push_back({c.cell, c.from, c.begin, c.end, Bar::Kind::kMove, barred});
}

SafeIntervals::RestrictedCorridor& SafeIntervals::restricted_corridor(int corridor) {
  const auto known =
      std::ranges::find(restricted_corridors_, corridor, &RestrictedCorridor::corridor);
  return known != restricted_corridors_.end()
             ? *known
             : restricted_corridors_.emplace_back(RestrictedCorridor{corridor});
}

SafeIntervals::Group& SafeIntervals::group(Place place) {
  if (unconstrained(place)) {
    group_of_[place] = static_cast<std::int32_t>(groups_.size());
    groups_.push_back({.place = place});
  }
  return groups_[group_of_[place]];
}

void SafeIntervals::group_inner_places() {
  for (std::size_t used = 0; used < restricted_corridors_.size(); ++used) {
    const auto places = corridors_->places(restricted_corridors_[used].corridor);
    for (const Place inner : places.subspan(1, places.size() - 2))
      group(inner).corridor = static_cast<std::int32_t>(used);
    group(places[1]).front = places.front();
  }
}

void SafeIntervals::group_bars() {
  const auto end_of_kind = [this](std::size_t i, Place place, Bar::Kind last) {
    while (i < bars_.size() && bars_[i].place == place && bars_[i].kind <= last) ++i;
    return i;
  };
  for (std::size_t i = 0; i < bars_.size();) {
    const Place place = bars_[i].place;
    Group& g = group(place);
    g.first_bar = static_cast<std::int32_t>(i);
    i = end_of_kind(i, place, Bar::Kind::kRest);
    g.first_move = static_cast<std::int32_t>(i);
    i = end_of_kind(i, place, Bar::Kind::kMove);
    g.end_move = static_cast<std::int32_t>(i);
    GROVE_ASSERT(g.first_bar < g.end_move, "the bars are in order of their places");
  }
}

void SafeIntervals::add(const SafeInterval& interval) {
  GROVE_ASSERT(interval.begin >= 0 && interval.begin <= interval.last_arrival &&
                   interval.last_arrival <= interval.end,
               "an interval begins at time 0 or later and is not empty");
  GROVE_ASSERT(intervals_.empty() || intervals_.back().state != interval.state ||
                   intervals_.back().copy != interval.copy ||
                   intervals_.back().last_arrival < interval.begin,
               "the arrivals in the intervals of a state are disjoint and in order of time");
  intervals_.push_back(interval);
}

void SafeIntervals::add_slots(Group& group) {
  group.first_slot = slot_count();
  world_.for_each_state(group.place, [&](State state) {
    if (group.corridor != kNoCopies) {
      const RestrictedCorridor& used = restricted_corridors_[group.corridor];
      if (used.from_front != kFree) add_intervals(group, state, used.from_front);
      if (used.from_back != kFree) add_intervals(group, state, used.from_back);
    }
    add_intervals(group, state, kFree);
  });
  GROVE_ASSERT((slot_count() - group.first_slot) % world_.states_on(group.place) == 0,
               "the states on a place have equally many slots");
  group.slots = (slot_count() - group.first_slot) / world_.states_on(group.place);
}

void SafeIntervals::add_intervals(const Group& group, State state, std::uint8_t copy) {
  Time safe_from = 0;
  for (int i = group.first_bar; i < group.first_move; ++i) {
    const Bar& bar = bars_[i];
    if (bar.kind != Bar::Kind::kPlace) break;
    if (safe_from < bar.begin)
      add({state, safe_from, bar.begin - 1, bar.begin - 1, copy, false, kNoPlace});
    safe_from = std::max(safe_from, std::min(bar.end, kNever) + 1);
  }
  if (safe_from < kNever) add_unending_interval(group, state, safe_from, copy);
}

void SafeIntervals::add_unending_interval(const Group& group, State state, Time begin,
                                          std::uint8_t copy) {
  Time no_rest_by = -1;
  for (int i = group.first_bar; i < group.first_move; ++i)
    if (bars_[i].kind == Bar::Kind::kRest) no_rest_by = std::max(no_rest_by, bars_[i].end);
  no_rest_by = std::min(no_rest_by, kNever);
  // Adds the slot for arrivals from `begin` to `last`.
  const auto add = [&](Time last, bool may_rest, bool is_late = false) {
    if (begin > last || begin >= kNever) return;
    this->add({state, begin, kNever, last, copy, may_rest, kNoPlace, is_late});
    begin = last + 1;
  };
  add(no_rest_by, false);
  if (!states_are_places_ && group.place == only_rest_) {
    add(latest_rest_, true);
    add(kNever, false, true);
  } else {
    add(kNever, true);
  }
}

SafeIntervals::Range SafeIntervals::slots_of_copy(const Group& group, State state,
                                                  std::uint8_t copy) const {
  const RestrictedCorridor& used = restricted_corridors_[group.corridor];
  const int before =
      static_cast<int>(copy > used.from_front) + static_cast<int>(copy > used.from_back);
  const int copies =
      1 + static_cast<int>(used.from_front != kFree) + static_cast<int>(used.from_back != kFree);
  const int each = group.slots / copies;
  const int first = slots(group, state).first + before * each;
  GROVE_ASSERT(each * copies == group.slots, "the copies of a place have equally many slots");
  GROVE_ASSERT(each == 0 || (interval(first).copy == copy && interval(first).state == state &&
                             interval(first + each - 1).copy == copy),
               "the slots of a copy are contiguous");
  return {first, first + each};
}

int SafeIntervals::start_slot(State state) const {
  const Place place = world_.place(state);
  if (unconstrained(place)) return state;
  const Group& g = groups_[group_of_[place]];
  const Range there = has_copies(place) ? slots_of_copy(g, state, kFree) : slots(g, state);
  return there.first < there.end && begin_of(there.first) == 0 ? there.first : -1;
}

Time SafeIntervals::rest_begin(Place place) const {
  for (int slot = first_slot(place); slot < end_slot(place); ++slot)
    if (may_rest(slot)) return begin_of(slot);
  return kNever;
}

Time SafeIntervals::next_begin(int slot) const {
  if (slot < states_ || slot + 1 >= slot_count()) return kNever;
  const SafeInterval& here = interval(slot);
  const SafeInterval& next = interval(slot + 1);
  return next.state == here.state && next.copy == here.copy ? next.begin : kNever;
}

Time SafeIntervals::first_move(int from_slot, Place to, Time earliest) const {
  if (unconstrained(to)) return earliest;
  const Group& group = groups_[group_of_[to]];
  // One pass suffices, because the bars are in order of their first times.
  for (int i = group.first_move; i < group.end_move; ++i)
    if (bars(bars_[i], from_slot, earliest)) earliest = std::min(bars_[i].end, kNever) + 1;
  GROVE_ASSERT(earliest > kNever || !is_barred(group, from_slot, earliest),
               "the first move is not barred");
  return earliest;
}

Time SafeIntervals::last_move(int from_slot, Place to, Time latest) const {
  if (unconstrained(to)) return latest;
  const Group& group = groups_[group_of_[to]];
  // One pass suffices here, too, because each bar begins no earlier than the bars after it in this
  // loop.
  for (int i = group.end_move - 1; i >= group.first_move; --i)
    if (bars(bars_[i], from_slot, latest)) latest = bars_[i].begin - 1;
  GROVE_ASSERT(!is_barred(group, from_slot, latest), "the last move is not barred");
  return latest;
}

}  // namespace grove::detail
