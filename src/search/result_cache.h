// SPDX-License-Identifier: MIT
// Caches of proven results on agents, pairs and groups: one shared by all workers, one per worker.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "search/dependency_table.h"
#include "search/mdd_cache.h"
#include "search/path_planner.h"
#include "search/subproblem_table.h"

namespace grove::detail {

// Results of one worker that are not in the shared cache yet. A value; the subproblem numbers are
// those of one SharedCache.
struct CacheDelta {
  using Id = SubproblemTable::Id;
  struct Pair {
    Id first;
    Id second;
    AgentIndex agent;
    DependencyTable::ExcessBound known;
  };
  std::unordered_map<Id, SubproblemTable::CostBound> costs;
  std::unordered_map<Id, MddCache::Set> sets;  // all that were requested
  // Searched linearly, because there are few at a time.
  std::vector<Pair> pairs;
  std::vector<DependencyTable::Group> groups;
};

// Entries added to a SharedCache since the last call of take_new_entries(); see CacheDelta. A
// value.
struct NewEntries {
  std::vector<std::pair<SubproblemTable::Id, SubproblemTable::CostBound>> costs;
  std::vector<CacheDelta::Pair> pairs;
  std::vector<DependencyTable::Group> groups;
};

// Cache of all workers in this process. Thread-safe. Entries of subproblems and excesses are never
// removed: to drop them, the caller replaces the whole cache by a new one.
struct SharedCache {
  SharedCache() = default;
  // Tag: the new cache replaces one that was full.
  struct Successor {};
  explicit SharedCache(Successor /*successor*/) : follows_another(true) {}

  SubproblemTable subproblems;
  MddCache path_sets;
  DependencyTable excesses{subproblems};
  // If true, an earlier cache was full, so results in this one may be dropped before they are of
  // use.
  const bool follows_another = false;
  // Unique among all caches of this process.
  const std::int64_t number = next_number();

  // Merges the results of one worker. The result does not depend on the order in which workers do
  // so.
  void merge(const CacheDelta& found);
  // Returns the entries that merge() added or improved since the last call. Recording begins with
  // the first call.
  NewEntries take_new_entries();

  // Drops MDDs if there are too many; they can be computed again.
  void trim() { path_sets.trim(); }
  std::size_t bytes() const { return subproblems.bytes() + path_sets.bytes() + excesses.bytes(); }

 private:
  static std::int64_t next_number();

  std::atomic<bool> keeps_new_entries_{false};
  std::mutex news_mutex_;
  NewEntries news_;
};

// Cache of one worker: the shared cache, and the worker's own results that are not shared yet.
// Results of other workers do not reach it before they are merged into the shared cache. So a
// worker that is given the same shared cache again does the same work, whatever the others do
// concurrently. One thread at a time.
class WorkerCache {
 public:
  using Id = SubproblemTable::Id;

  // `planner` must outlive this. An MDD of more than `max_set_nodes` nodes is not built.
  WorkerCache(PathPlanner& planner, std::shared_ptr<SharedCache> common, std::int64_t max_set_nodes)
      : planner_(planner), common_(std::move(common)), max_set_nodes_(max_set_nodes) {}

  // Removes and returns the results since the last call. This worker sees them again once they are
  // in the shared cache.
  CacheDelta take_delta() { return std::exchange(found_, {}); }
  // Uses this shared cache from now on. If it is a different one, results that were not taken are
  // dropped, and all subproblem numbers become invalid.
  void use_shared_cache(std::shared_ptr<SharedCache> common);
  const std::shared_ptr<SharedCache>& common() const { return common_; }
  // Number of the shared cache: subproblem numbers stay valid as long as it is the same.
  std::int64_t numbering() const { return common_->number; }

  // As the methods of SubproblemTable.
  Id id(AgentIndex agent, const AgentSequencing& order, std::span<const Constraint> constraints) {
    ++asked_;
    return common_->subproblems.id(agent, order, constraints);
  }
  // Subproblem queries so far, and groups that were examined for an answer.
  std::int64_t asked() const { return asked_; }
  std::int64_t groups_asked() const { return groups_asked_; }
  // MDD queries so far, and those of them that the cache could answer.
  std::int64_t mdd_queries() const { return sets_asked_; }
  std::int64_t mdd_hits() const { return sets_known_; }
  SubproblemTable::CostBound known(Id id) const;
  void merge(Id id, SubproblemTable::CostBound known) { found_.costs[id] = known; }

  // MDD of a subproblem, built if it is not cached; empty if it would be too large. Returns nullptr
  // if a limit was reached. Valid until take_delta().
  const Mdd* paths(Id id, AgentIndex agent, const AgentSequencing& order,
                   std::span<const Constraint> constraints, Time cost, const Limits& limits);

  // As the methods of DependencyTable. Partners and groups come in any order and possibly
  // repeatedly.
  DependencyTable::ExcessBound of_pair(Id first, Id second) const;
  void merge_pair(Id first, Id second, AgentIndex agent, DependencyTable::ExcessBound known);
  void partners(Id first, std::vector<DependencyTable::Partner>& partners) const;
  DependencyTable::ExcessBound of_group(const std::vector<Id>& subproblems) const;
  void merge_group(const std::vector<AgentIndex>& agents, const std::vector<Id>& subproblems,
                   DependencyTable::ExcessBound known);
  template <class Use>
  void groups_at(const std::vector<Id>& now, Use use) const {
    groups_asked_ += common_->excesses.groups_at(now, use);
    for (const DependencyTable::Group& group : found_.groups)
      if (group.is_at(now)) use(group);
  }

 private:
  PathPlanner& planner_;
  std::shared_ptr<SharedCache> common_;
  const std::int64_t max_set_nodes_;
  std::int64_t asked_ = 0;
  mutable std::int64_t groups_asked_ = 0;
  std::int64_t sets_asked_ = 0;
  std::int64_t sets_known_ = 0;
  CacheDelta found_;
};

}  // namespace grove::detail
