// SPDX-License-Identifier: MIT
// The digest is the sum over all rows, modulo 2^64, of the multiplier times a hash of the row.
// Therefore it can be updated in O(1) when a multiplier changes, and it depends neither on the
// order of the changes nor on the numbering of the rows.
#include "lagrangian/multipliers.h"

#include <algorithm>
#include <stdexcept>

namespace grove::detail {
namespace {

constexpr Time kMaxTime = 1 << 24;  // limit on the times of a row; actual times are far below

// The output function of SplitMix64.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

std::uint64_t number_of(const RelaxedRow& row) {
  std::uint64_t number = static_cast<std::uint64_t>(row.kind);
  for (const std::int32_t part : {row.a, row.b, row.time, row.time_b})
    number = mix(number ^ static_cast<std::uint32_t>(part));
  return number | 1;
}

// Varint encoding: seven bits per byte, lowest bits first. The highest bit of a byte is set if more
// bytes follow.
void write(std::string& to, std::uint32_t number) {
  for (; number >= 0x80; number >>= 7) to.push_back(static_cast<char>(number | 0x80));
  to.push_back(static_cast<char>(number));
}

std::uint32_t read(const std::string& from, std::size_t& at) {
  std::uint32_t number = 0;
  for (unsigned bits = 0; bits < 32; bits += 7) {
    if (at == from.size()) break;
    const auto byte = static_cast<unsigned char>(from[at++]);
    number |= static_cast<std::uint32_t>(byte & 0x7f) << bits;
    if (byte < 0x80) return number;
  }
  throw std::invalid_argument("multipliers: update is cut short");
}

// Zigzag encoding: maps amounts of small absolute value to small unsigned numbers.
std::uint32_t folded(std::int32_t amount) {
  return (static_cast<std::uint32_t>(amount) << 1) ^ static_cast<std::uint32_t>(amount >> 31);
}

std::int32_t unfolded(std::uint32_t number) {
  return static_cast<std::int32_t>((number >> 1) ^ (0 - (number & 1)));
}

}  // namespace

Multipliers::Multipliers(const World& world, int agents)
    : world_(world), penalties_(world), on_finish_(static_cast<std::size_t>(agents)) {}

ScaledCost Multipliers::price(AgentIndex agent, const Path& path) const {
  const auto finish = path.size() - 1;
  ScaledCost price = static_cast<ScaledCost>(finish) * Penalties::kUnit;
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

void Multipliers::add(const RelaxedRow& row) {
  rows_.push_back(row);
  multipliers_.push_back(0);
}

void Multipliers::set_multiplier(RowId id, Amount amount) {
  const Amount more = amount - multipliers_[id];
  if (more == 0) return;
  put_on_path(rows_[id], more);
  multipliers_[id] = amount;
  sum_ += more;
  digest_ += number_of(rows_[id]) * static_cast<std::uint64_t>(std::int64_t{more});
}

void Multipliers::put_on_path(const RelaxedRow& row, Amount more) {
  switch (row.kind) {
    case RelaxedRow::Kind::kPlace:
      for (const auto arc : penalties_.arcs_to(row.a)) penalties_.add(row.time, arc, more);
      return;
    case RelaxedRow::Kind::kEdge:
      penalties_.add(row.time, penalties_.arc(row.a, row.b), more);
      penalties_.add(row.time, penalties_.arc(row.b, row.a), more);
      penalties_.add(row.time, penalties_.staying(row.a), more);
      return;
    case RelaxedRow::Kind::kFinish:
      put_on_finish(row.a, row.time, more);
      put_on_finish(row.b, row.time_b, more);
  }
}

void Multipliers::put_on_finish(AgentIndex agent, Time by, Amount more) {
  std::vector<Amount>& on_finish = on_finish_[agent];
  if (std::ssize(on_finish) <= by) on_finish.resize(static_cast<std::size_t>(by) + 1);
  for (Time time = 0; time <= by; ++time) on_finish[time] += more;
}

MultiplierUpdate Multipliers::update_for(std::vector<Amount>& known) const {
  MultiplierUpdate update;
  update.rows.assign(rows_.begin() + std::ssize(known), rows_.end());
  known.resize(rows_.size());
  std::uint32_t passed = 0;
  for (RowId id = 0; id < rows_.size(); ++id) {
    if (known[id] == multipliers_[id]) {
      ++passed;
      continue;
    }
    write(update.multipliers, passed);
    write(update.multipliers, folded(multipliers_[id] - known[id]));
    passed = 0;
  }
  known = multipliers_;
  return update;
}

void Multipliers::apply(const MultiplierUpdate& update) {
  for (const RelaxedRow& row : update.rows) {
    if (!is_valid_row(row)) throw std::invalid_argument("multipliers: row of another instance");
    add(row);
  }
  std::uint64_t id = 0;
  for (std::size_t at = 0; at < update.multipliers.size(); ++id) {
    id += read(update.multipliers, at);
    const std::int64_t more = unfolded(read(update.multipliers, at));
    if (id >= rows_.size()) throw std::invalid_argument("multipliers: unknown row");
    const std::int64_t multiplier = multipliers_[id] + more;
    if (multiplier < 0 || multiplier > PenalizedSearch::kMaxPenaltyCost)
      throw std::invalid_argument("multiplier out of range");
    set_multiplier(static_cast<RowId>(id), static_cast<Amount>(multiplier));
  }
}

bool Multipliers::is_valid_row(const RelaxedRow& row) const {
  const auto is_agent = [&](std::int32_t agent) {
    return agent >= 0 && agent < std::ssize(on_finish_);
  };
  const auto is_place = [&](std::int32_t place) {
    return place >= 0 && place < world_.place_count();
  };
  const auto is_time = [](Time time) { return time >= 0 && time < kMaxTime; };
  if (!is_time(row.time) || !is_time(row.time_b)) return false;
  switch (row.kind) {
    case RelaxedRow::Kind::kPlace:
      return is_place(row.a);
    case RelaxedRow::Kind::kEdge: {
      if (!is_place(row.a) || !is_place(row.b)) return false;
      const auto is_next = [&](Place from, Place to) {
        return std::ranges::find(world_.neighbors(from), to) != world_.neighbors(from).end();
      };
      return is_next(row.a, row.b) && is_next(row.b, row.a);
    }
    case RelaxedRow::Kind::kFinish:
      return is_agent(row.a) && is_agent(row.b);
  }
  return false;
}

}  // namespace grove::detail
