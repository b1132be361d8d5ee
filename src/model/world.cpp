// SPDX-License-Identifier: MIT
#include "model/world.h"

#include <algorithm>
#include <utility>

#include "model/assert.h"

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

bool ranks_are_consecutive(const World& world) {
  for (Place place = 0; place < world.place_count(); ++place) {
    int rank = 0;
    bool consecutive = true;
    world.for_each_state(place, [&](State state) {
      consecutive =
          consecutive && world.place(state) == place && world.rank_on_place(state) == rank++;
    });
    if (!consecutive || rank != world.states_on(place)) return false;
  }
  return true;
}

int longest_row(const CsrArray& rows) {
  std::size_t longest = 0;
  for (std::int32_t row = 0; row < rows.count(); ++row)
    longest = std::max(longest, rows[row].size());
  return static_cast<int>(longest);
}

}  // namespace

WorkingStates::WorkingStates(State first, std::vector<Work> work, std::span<const Place> place_of,
                             Place places, int bases_on_a_place)
    : first_(first), work_(std::move(work)), rank_(work_.size()) {
  std::vector<std::vector<State>> on_place(static_cast<std::size_t>(places));
  for (std::size_t w = 0; w < work_.size(); ++w) {
    std::vector<State>& here = on_place[place_of[w]];
    rank_[w] = bases_on_a_place + static_cast<std::int32_t>(here.size());
    here.push_back(first + static_cast<State>(w));
  }
  for (const std::vector<State>& here : on_place) {
    for (const State state : here) on_place_.add(state);
    on_place_.end_row();
  }
}

int WorkingStates::max_on_a_place() const {
  return longest_row(on_place_);
}

World::World(CsrArray moves)
    : places_(moves.count()),
      max_moves_(longest_row(moves)),
      moves_(std::move(moves)),
      working_(moves_.count()) {
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
      moves_(std::move(moves)),
      working_(moves_.count()) {
  GROVE_ASSERT(same_sets(moves_, reversed(moves_)), "each move of a grid has its reverse");
}

World::World(const World& ground, std::vector<Kind> kinds, std::vector<Work> work, CsrArray moves)
    : places_(ground.place_count()),
      row_width_(ground.row_width()),
      max_moves_(longest_row(moves)),
      is_symmetric_(false),
      has_other_neighbors_(true),
      moves_(std::move(moves)),
      moves_back_(reversed(moves_)),
      kinds_(std::move(kinds)),
      working_(moves_.count() - static_cast<State>(work.size())) {
  bases_on_a_place_ = 0;
  for (const Kind& kind : kinds_) bases_on_a_place_ += kind.on_a_place;
  for (std::size_t k = 1; k < kinds_.size(); ++k)
    for (Place place = 0; place < places_; ++place)
      place_of_.insert(place_of_.end(), kinds_[k].on_a_place, place);
  std::vector<Place> work_places;
  for (const Work& w : work) work_places.push_back(place(w.base));
  place_of_.insert(place_of_.end(), work_places.begin(), work_places.end());
  const State first = moves_.count() - static_cast<State>(work.size());
  working_ = WorkingStates(first, std::move(work), work_places, places_, bases_on_a_place_);
  for (Place here = 0; here < places_; ++here) {
    for (const Place there : ground.neighbors(here)) neighbors_.add(there);
    neighbors_.end_row();
  }
  max_states_on_a_place_ = bases_on_a_place_ + working_.max_on_a_place();
  GROVE_CHECK(static_cast<std::int64_t>(places_) * bases_on_a_place_ == first,
              "the states at work are numbered directly after the base states");
  GROVE_CHECK(std::ssize(place_of_) == state_count() - places_, "each state has one place");
  GROVE_ASSERT(ranks_are_consecutive(*this), "the states on a place have the ranks 0, 1, ...");
}

int World::kind_of_base(State state) const {
  int kind = kind_count() - 1;
  while (kinds_[kind].first > state) --kind;
  return kind;
}

int World::rank_of(State state) const {
  if (is_working(state)) return working_.rank_on_place(state);
  int before = 0;
  int kind = 0;
  while (kind + 1 < kind_count() && kinds_[kind + 1].first <= state)
    before += kinds_[kind++].on_a_place;
  return before + (state - kinds_[kind].first) % kinds_[kind].on_a_place;
}

}  // namespace grove::detail
