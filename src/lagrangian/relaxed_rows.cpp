// SPDX-License-Identifier: MIT
// *Claim: a plan uses each row at most once.* *Proof*, with the definition of a use, by kind of
// row:
//
// *Place at a time.* An agent uses the row if it is on the place at that time, at rest or not. Two
// such agents would collide.
//
// *Edge u - v at a time t*, where u has the lower number. An agent uses the row if in the step that
// ends at t it moves from u to v or from v to u, or stays on u. Two agents that move in the same
// direction, or both stay on u, would be on one place. Two agents that move in opposite directions
// would swap. An agent that stays on u would be on the place that the other agent leaves or enters.
// An agent makes one step at a time, so it uses the row at most once.
//
// *Pair of finish times.* Agent a uses the row if it finishes at its time in the row or earlier,
// and agent b uses it if it finishes at its own time in the row or earlier. A row is added only
// after the proof that no plan contains both (finish_time_conflicts.cpp). Each agent finishes once.
//
// *Arithmetic.* Multipliers are nonnegative integers. The bound is computed from these integers, so
// its validity does not depend on the floating-point arithmetic that chooses them.
#include "lagrangian/relaxed_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grove::detail {
namespace {

// Upper limit on a multiplier: the cost of 64 time steps. In practice multipliers do not exceed a
// few time steps.
constexpr double kGreatestMultiplier = 64.0 * Penalties::kUnit;

std::uint64_t pair_key(const FinishTimePair& pair) {
  return static_cast<std::uint64_t>(pair.a) << 32 | static_cast<std::uint32_t>(pair.b);
}

}  // namespace

RelaxedRows::RelaxedRows(const World& world, int agents)
    : world_(world),
      multipliers_(world, agents),
      has_edge_rows_(static_cast<std::size_t>(world.place_count())) {}

std::uint64_t RelaxedRows::place_key(Place place, Time time) const {
  return static_cast<std::uint64_t>(time) * static_cast<std::uint64_t>(world_.place_count()) +
         static_cast<std::uint64_t>(place);
}

// An edge is identified by its arc from the place with the lower number.
std::uint64_t RelaxedRows::edge_key(Place from, Place to, Time arrival) const {
  const auto arc = multipliers_.penalties().arc(std::min(from, to), std::max(from, to));
  return static_cast<std::uint64_t>(arrival) << 32 | static_cast<std::uint32_t>(arc);
}

RelaxedRows::RowId RelaxedRows::add_row(const RelaxedRow& row) {
  const auto id = static_cast<RowId>(row_states_.size());
  multipliers_.add(row);
  row_states_.emplace_back();
  return id;
}

void RelaxedRows::add_row(std::unordered_map<std::uint64_t, RowId>& rows, std::uint64_t key,
                          const RelaxedRow& row) {
  if (!rows.contains(key)) rows.emplace(key, add_row(row));
}

void RelaxedRows::add(const Collision& c) {
  if (c.before == kNoPlace)
    return add_row(place_rows_, place_key(c.place, c.time),
                   {.kind = Kind::kPlace, .a = c.place, .time = c.time});
  const auto [a, b] = std::minmax(c.place, c.before);
  has_edge_rows_[a] = 1;
  add_row(edge_rows_, edge_key(a, b, c.time),
          {.kind = Kind::kEdge, .a = a, .b = b, .time = c.time});
}

void RelaxedRows::add(const FinishTimePair& pair) {
  finish_rows_[pair_key(pair)].push_back(add_row({.kind = Kind::kFinish,
                                                  .a = pair.a,
                                                  .b = pair.b,
                                                  .time = pair.finish_a,
                                                  .time_b = pair.finish_b}));
}

bool RelaxedRows::has(const FinishTimePair& pair) const {
  const auto rows = finish_rows_.find(pair_key(pair));
  return rows != finish_rows_.end() && std::ranges::any_of(rows->second, [&](RowId id) {
           const RelaxedRow& row = multipliers_.row(id);
           return row.time >= pair.finish_a && row.time_b >= pair.finish_b;
         });
}

double RelaxedRows::update_direction(std::span<const Path> paths, const OccupancyCounts& occupancy,
                                     double memory) {
  count_uses(paths, occupancy);
  double squares = 0;
  for (RowState& row : row_states_) {
    const bool is_zero = row.exact_multiplier <= 0;  // the multiplier cannot decrease
    double direction = row.used - 1;
    if (is_zero) direction = std::max(direction, 0.0);
    direction += memory * row.direction;
    row.direction = is_zero ? std::max(direction, 0.0) : direction;
    squares += row.direction * row.direction;
  }
  return squares;
}

void RelaxedRows::count_uses(std::span<const Path> paths, const OccupancyCounts& occupancy) {
  const auto finishes_by = [&](AgentIndex agent, Time time) {
    return !paths[agent].empty() && static_cast<Time>(paths[agent].size()) - 1 <= time ? 1 : 0;
  };
  for (RowId id = 0; id < row_states_.size(); ++id) {
    const RelaxedRow& row = multipliers_.row(id);
    std::int32_t& used = row_states_[id].used;
    used = 0;
    if (row.kind == Kind::kPlace) used = occupancy.at(row.a, row.time);
    if (row.kind == Kind::kFinish)
      used = finishes_by(row.a, row.time) + finishes_by(row.b, row.time_b);
  }
  for (const Path& path : paths)
    if (!path.empty()) count_moves(path, std::max(occupancy.end(), multipliers_.penalties().end()));
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
  if (row != edge_rows_.end()) ++row_states_[row->second].used;
}

void RelaxedRows::take_step(double step) {
  for (RowId id = 0; id < row_states_.size(); ++id) {
    RowState& row = row_states_[id];
    if (row.direction == 0) continue;
    row.exact_multiplier =
        std::clamp(row.exact_multiplier + step * row.direction, 0.0, kGreatestMultiplier);
    multipliers_.set_multiplier(
        id, static_cast<Multipliers::Amount>(std::lround(row.exact_multiplier)));
  }
}

}  // namespace grove::detail
