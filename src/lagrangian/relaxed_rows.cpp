// SPDX-License-Identifier: MIT
// Why in no plan two agents use one row, nor one agent twice.
//
// *A place at a time*: to be there then, at rest or not. Two would collide.
//
// *An edge u - v at a time*, u being the one of the lesser number: to arrive at that time by u -> v
// or by v -> u, or having stayed on u. Two that move the same way, or stay on u, share a place; two
// that move against each other swap; and who stays on u is on the place that the other leaves or
// comes to. An agent arrives once at a time.
//
// *A pair of finish times*: agent a comes to rest by its time, or agent b by its own; for these two
// alone, and proven by finish_pairs.h. Each finishes once.
//
// Multipliers are never negative, and what is charged to an agent is the sum of those of the rows
// that its path uses; being integers there, they are what is proven with, whatever the arithmetic
// that chose them.
#include "grove/detail/lagrangian/relaxed_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grove::detail {
namespace {

// A unit is a step of one agent; no row was ever seen to be worth more than a few.
constexpr double kGreatestMultiplier = 64.0 * Penalties::kUnit;

std::uint64_t pair_key(const FinishPair& pair) {
  return static_cast<std::uint64_t>(pair.a) << 32 | static_cast<std::uint32_t>(pair.b);
}

}  // namespace

RelaxedRows::RelaxedRows(const World& world, int agents)
    : world_(world),
      penalties_(world),
      on_finish_(static_cast<std::size_t>(agents)),
      has_edge_rows_(static_cast<std::size_t>(world.place_count())) {}

Price RelaxedRows::price(AgentIndex agent, const Path& path) const {
  const auto finish = path.size() - 1;
  Price price = static_cast<Price>(finish) * Penalties::kUnit;
  if (finish < on_finish_[agent].size()) price += on_finish_[agent][finish];
  Place from = world_.place(path[0]);
  for (Time time = 1; time < static_cast<Time>(path.size()); ++time) {
    const Place to = world_.place(path[time]);
    price += penalties_.of(time, penalties_.arc(from, to));
    from = to;
  }
  for (auto time = static_cast<Time>(path.size()); time < penalties_.end(); ++time)
    price += penalties_.of(time, penalties_.staying(from));
  return price;
}

std::uint64_t RelaxedRows::place_key(Place place, Time time) const {
  return static_cast<std::uint64_t>(time) * static_cast<std::uint64_t>(world_.place_count()) +
         static_cast<std::uint64_t>(place);
}

// An edge is its arc from the lesser place.
std::uint64_t RelaxedRows::edge_key(Place from, Place to, Time arrival) const {
  const auto arc = penalties_.arc(std::min(from, to), std::max(from, to));
  return static_cast<std::uint64_t>(arrival) << 32 | static_cast<std::uint32_t>(arc);
}

void RelaxedRows::add_row(std::unordered_map<std::uint64_t, RowId>& rows, std::uint64_t key,
                          Row row) {
  if (rows.try_emplace(key, static_cast<RowId>(rows_.size())).second) rows_.push_back(row);
}

void RelaxedRows::add(const Collision& c) {
  Row row{.kind = Kind::kPlace, .a = c.place, .b = c.before, .time = c.time};
  if (c.before == kNoPlace) return add_row(place_rows_, place_key(c.place, c.time), row);
  row.kind = Kind::kEdge;
  if (row.a > row.b) std::swap(row.a, row.b);
  has_edge_rows_[row.a] = 1;
  add_row(edge_rows_, edge_key(row.a, row.b, c.time), row);
}

void RelaxedRows::add(const FinishPair& pair) {
  finish_rows_[pair_key(pair)].push_back(static_cast<RowId>(rows_.size()));
  rows_.push_back({.kind = Kind::kFinish,
                   .a = pair.a,
                   .b = pair.b,
                   .time = pair.finish_a,
                   .time_b = pair.finish_b});
}

bool RelaxedRows::has(const FinishPair& pair) const {
  const auto rows = finish_rows_.find(pair_key(pair));
  return rows != finish_rows_.end() && std::ranges::any_of(rows->second, [&](RowId id) {
           return rows_[id].time >= pair.finish_a && rows_[id].time_b >= pair.finish_b;
         });
}

double RelaxedRows::turn(std::span<const Path> paths, const Encounters& encounters, double memory) {
  count_uses(paths, encounters);
  double squares = 0;
  for (Row& row : rows_) {
    const bool is_at_rest = row.multiplier <= 0;  // and cannot go down
    double direction = row.used - 1;
    if (is_at_rest) direction = std::max(direction, 0.0);
    direction += memory * row.direction;
    row.direction = is_at_rest ? std::max(direction, 0.0) : direction;
    squares += row.direction * row.direction;
  }
  return squares;
}

void RelaxedRows::count_uses(std::span<const Path> paths, const Encounters& encounters) {
  const auto finishes_by = [&](AgentIndex agent, Time time) {
    return !paths[agent].empty() && static_cast<Time>(paths[agent].size()) - 1 <= time ? 1 : 0;
  };
  for (Row& row : rows_) {
    row.used = 0;
    if (row.kind == Kind::kPlace) row.used = encounters.at(row.a, row.time);
    if (row.kind == Kind::kFinish)
      row.used = finishes_by(row.a, row.time) + finishes_by(row.b, row.time_b);
  }
  for (const Path& path : paths)
    if (!path.empty()) count_moves(path, std::max(encounters.end(), penalties_.end()));
}

void RelaxedRows::count_moves(const Path& path, Time end) {
  Place from = world_.place(path[0]);
  for (Time time = 1; time < end; ++time) {
    const Place to = place_at(world_, path, time);
    if (has_edge_rows_[std::min(from, to)]) count_move(from, to, time);
    from = to;
  }
}

void RelaxedRows::count_move(Place from, Place to, Time arrival) {
  if (from != to) return use_edge(from, to, arrival);
  for (const Place other : world_.neighbors(from))
    if (other > from) use_edge(from, other, arrival);
}

void RelaxedRows::use_edge(Place from, Place to, Time arrival) {
  const auto row = edge_rows_.find(edge_key(from, to, arrival));
  if (row != edge_rows_.end()) ++rows_[row->second].used;
}

void RelaxedRows::go(double step) {
  for (Row& row : rows_) {
    if (row.direction == 0) continue;
    row.multiplier = std::clamp(row.multiplier + step * row.direction, 0.0, kGreatestMultiplier);
    give(row);
  }
}

void RelaxedRows::give(Row& row) {
  const auto amount = static_cast<Amount>(std::lround(row.multiplier));
  const Amount more = amount - row.given;
  if (more == 0) return;
  charge(row, more);
  sum_ += more;
  row.given = amount;
}

void RelaxedRows::charge(const Row& row, Amount more) {
  switch (row.kind) {
    case Kind::kPlace:
      for (const auto arc : penalties_.arcs_to(row.a)) penalties_.add(row.time, arc, more);
      return;
    case Kind::kEdge:
      penalties_.add(row.time, penalties_.arc(row.a, row.b), more);
      penalties_.add(row.time, penalties_.arc(row.b, row.a), more);
      penalties_.add(row.time, penalties_.staying(row.a), more);
      return;
    case Kind::kFinish:
      charge_finish(row.a, row.time, more);
      charge_finish(row.b, row.time_b, more);
  }
}

void RelaxedRows::charge_finish(AgentIndex agent, Time by, Amount more) {
  std::vector<Amount>& on_finish = on_finish_[agent];
  if (std::ssize(on_finish) <= by) on_finish.resize(static_cast<std::size_t>(by) + 1);
  for (Time time = 0; time <= by; ++time) on_finish[time] += more;
}

}  // namespace grove::detail
