// SPDX-License-Identifier: MIT
#include "model/world.h"

#include <algorithm>
#include <utility>

namespace grove::detail {
namespace {

// Returns the reverse graph, in which each row is in ascending order.
CsrArray reversed(const CsrArray& rows) {
  std::vector<std::int32_t> first(static_cast<std::size_t>(rows.count()) + 1);
  for (const std::int32_t to : rows.items()) ++first[static_cast<std::size_t>(to) + 1];
  for (std::size_t row = 1; row < first.size(); ++row) first[row] += first[row - 1];
  std::vector<std::int32_t> back(rows.items().size());
  std::vector<std::int32_t> next(first.begin(), first.end() - 1);
  for (std::int32_t from = 0; from < rows.count(); ++from)
    for (const std::int32_t to : rows[from]) back[next[to]++] = from;
  CsrArray result;
  for (std::size_t row = 0; row + 1 < first.size(); ++row) {
    for (std::int32_t i = first[row]; i < first[row + 1]; ++i) result.add(back[i]);
    result.end_row();
  }
  return result;
}

bool same_sets(const CsrArray& a, const CsrArray& b) {
  for (std::int32_t row = 0; row < a.count(); ++row)
    if (!std::ranges::is_permutation(a[row], b[row])) return false;
  return true;
}

// Returns the union of `a` and `b`, row by row.
CsrArray joined(const CsrArray& a, const CsrArray& b) {
  CsrArray both;
  for (std::int32_t row = 0; row < a.count(); ++row) {
    for (const std::int32_t item : a[row]) both.add(item);
    for (const std::int32_t item : b[row])
      if (std::ranges::count(a[row], item) == 0) both.add(item);
    both.end_row();
  }
  return both;
}

int longest_row(const CsrArray& rows) {
  std::size_t longest = 0;
  for (std::int32_t row = 0; row < rows.count(); ++row)
    longest = std::max(longest, rows[row].size());
  return static_cast<int>(longest);
}

}  // namespace

World::World(CsrArray moves)
    : places_(moves.count()),
      max_moves_(longest_row(moves)),
      first_working_(moves.count()),
      moves_(std::move(moves)) {
  CsrArray back = reversed(moves_);
  is_symmetric_ = same_sets(moves_, back);
  if (is_symmetric_) return;
  neighbors_ = joined(moves_, back);
  has_other_neighbors_ = true;
  moves_back_ = std::move(back);
}

World::World(CsrArray moves, Place row_width)
    : places_(moves.count()),
      row_width_(row_width),
      max_moves_(longest_row(moves)),
      first_working_(moves.count()),
      moves_(std::move(moves)) {}

World::World(const World& ground, std::vector<Kind> kinds, std::vector<Work> work, CsrArray moves)
    : places_(ground.place_count()),
      row_width_(ground.row_width()),
      max_moves_(longest_row(moves)),
      is_symmetric_(false),
      has_other_neighbors_(true),
      first_working_(moves.count() - static_cast<State>(work.size())),
      moves_(std::move(moves)),
      moves_back_(reversed(moves_)),
      kinds_(std::move(kinds)),
      work_(std::move(work)),
      work_rank_(work_.size()) {
  bases_on_a_place_ = 0;
  for (const Kind& kind : kinds_) bases_on_a_place_ += kind.on_a_place;
  for (std::size_t k = 1; k < kinds_.size(); ++k)
    for (Place place = 0; place < places_; ++place)
      place_of_.insert(place_of_.end(), kinds_[k].on_a_place, place);
  std::vector<std::vector<State>> working(static_cast<std::size_t>(places_));
  for (std::size_t w = 0; w < work_.size(); ++w) {
    const Place here = place(work_[w].base);
    place_of_.push_back(here);
    work_rank_[w] = bases_on_a_place_ + static_cast<std::int32_t>(working[here].size());
    working[here].push_back(first_working_ + static_cast<State>(w));
  }
  for (Place here = 0; here < places_; ++here) {
    for (const State state : working[here]) working_.add(state);
    working_.end_row();
    for (const Place there : ground.neighbors(here)) neighbors_.add(there);
    neighbors_.end_row();
  }
  max_states_on_a_place_ = bases_on_a_place_ + longest_row(working_);
}

int World::kind_of_base(State state) const {
  int kind = kind_count() - 1;
  while (kinds_[kind].first > state) --kind;
  return kind;
}

int World::rank_of(State state) const {
  if (is_working(state)) return work_rank_[state - first_working_];
  int before = 0;
  int kind = 0;
  while (kind + 1 < kind_count() && kinds_[kind + 1].first <= state)
    before += kinds_[kind++].on_a_place;
  return before + (state - kinds_[kind].first) % kinds_[kind].on_a_place;
}

}  // namespace grove::detail
