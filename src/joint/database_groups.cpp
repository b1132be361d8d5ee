// SPDX-License-Identifier: MIT
#include "joint/database_groups.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

// Maximum entries of one database made before the search, and maximum effort of all of these
// (model/effort.h).
constexpr std::size_t kMaxEntries = std::size_t{1} << 18;
constexpr std::int64_t kMaxTableWork = 4'000'000;
// Maximum entries of one late database, and maximum number of agents with which there are late
// databases.
constexpr std::size_t kMaxLateEntries = std::size_t{1} << 21;
constexpr std::size_t kMaxGroupedLate = 6;

}  // namespace

void DatabaseGroups::plan() {
  const std::size_t size = agents_.size();
  if (size < 3 || size > kMaxGrouped) return;
  for (std::size_t a = 0; a < size; ++a)
    for (std::size_t b = a + 1; b < size; ++b) plan({a, b});
  for (std::size_t a = 0; a < size && size > 3; ++a)
    for (std::size_t b = a + 1; b < size; ++b)
      for (std::size_t c = b + 1; c < size; ++c) plan({a, b, c});
  std::ranges::stable_sort(late_, {}, [&](const Members& members) { return work_of(members); });
}

void DatabaseGroups::plan(Members members) {
  const std::size_t entries = PatternDatabase::entries(agents_, members);
  if (entries <= kMaxEntries && planned_work_ + work_of(members) <= kMaxTableWork) {
    planned_work_ += work_of(members);
    due_.push_back(std::move(members));
  } else if (entries <= kMaxLateEntries && agents_.size() <= kMaxGroupedLate) {
    late_.push_back(std::move(members));
  }
}

bool DatabaseGroups::make_first(std::deque<Members>& of, const Limits& limits) {
  auto database = PatternDatabase::make(instance_, agents_, of.front(), limits);
  if (!database) return false;
  databases_.push_back(std::move(*database));
  work_ += work_of(of.front());
  GROVE_CHECK(&of == &due_ || of.size() == 1 || work_of(of[0]) <= work_of(of[1]),
              "late databases are made in ascending order of effort");
  bytes_ += PatternDatabase::entries(agents_, of.front());
  of.pop_front();
  return true;
}

bool DatabaseGroups::make_next(const Limits& limits) {
  if (!make_first(due_, limits)) return false;
  if (!due_.empty()) return true;
  GROVE_CHECK(work_ == planned_work_, "the early databases take the planned effort");
  group();
  return true;
}

bool DatabaseGroups::is_late_due(std::int64_t of_search) const {
  return !late_.empty() && work_ + work_of(late_.front()) <= of_search;
}

bool DatabaseGroups::make_late(const Limits& limits) {
  GROVE_CHECK(due_.empty(), "late databases are made after all early ones");
  if (!make_first(late_, limits)) return false;
  group();
  return true;
}

void DatabaseGroups::group() {
  excess_.assign(databases_.size() + 1, 0);
  groupings_.clear();
  Grouping none;
  none.fill(static_cast<std::uint8_t>(databases_.size()));
  add_groupings(0, 0, none, 0);
  GROVE_ASSERT(std::ranges::adjacent_find(groupings_, std::greater_equal<>()) == groupings_.end(),
               "groupings are distinct and in lexicographic order");
}

// Adds all maximal groupings that extend `so_far` by databases with numbers >= `first` whose
// members are not in `taken`.
void DatabaseGroups::add_groupings(std::size_t first, unsigned taken, Grouping so_far,
                                   std::size_t count) {
  bool ends = true;
  for (std::size_t i = 0; i < databases_.size() && count < so_far.size(); ++i) {
    unsigned members = 0;
    for (const std::size_t member : databases_[i].members()) members |= 1u << member;
    if ((taken & members) != 0) continue;
    ends = false;
    if (i < first) continue;
    so_far[count] = static_cast<std::uint8_t>(i);
    add_groupings(i + 1, taken | members, so_far, count + 1);
  }
  if (ends && count > 0) groupings_.push_back(so_far);
}

Cost DatabaseGroups::excess(const Node* nodes) {
  for (std::size_t i = 0; i < databases_.size(); ++i) {
    const std::uint8_t excess = databases_[i].excess(nodes);
    if (excess == PatternDatabase::kUnreachable) return kInfiniteCost;
    excess_[i] = excess;
  }
  int best = 0;
  for (const Grouping& grouping : groupings_) {
    int sum = 0;
    for (const std::uint8_t database : grouping) sum += excess_[database];
    best = std::max(best, sum);
  }
  return best;
}

}  // namespace grove::detail
