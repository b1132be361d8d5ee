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

// Results of one worker that are not in the shared cache yet. Its subproblem numbers are valid for
// one SharedCache.
struct CacheDelta {
  using Id = SubproblemTable::Id;
  struct Pair {
    Id first;
    Id second;
    AgentIndex agent;
    DependencyTable::ExcessBound known;
  };
  std::unordered_map<Id, SubproblemTable::CostBound> costs;
  std::unordered_map<Id, MddCache::Set> mdds;  // all that the worker requested
  // `pairs` and `groups` are searched linearly, because they hold few entries at a time.
  std::vector<Pair> pairs;
  std::vector<DependencyTable::Group> groups;
};

// Entries that were added to a SharedCache or improved since the last call of take_new_entries().
// Their subproblem numbers are valid for that cache.
struct NewEntries {
  std::vector<std::pair<SubproblemTable::Id, SubproblemTable::CostBound>> costs;
  std::vector<CacheDelta::Pair> pairs;
  std::vector<DependencyTable::Group> groups;
};

// Cache shared by all workers of this process. Entries of subproblems and excesses are never
// removed; to drop them, the caller replaces the whole cache by a new one. Thread-safe.
struct SharedCache {
  SharedCache() = default;
  // Tag: the new cache replaces a full one.
  struct Successor {};
  explicit SharedCache(Successor /*successor*/) : follows_another(true) {}

  SubproblemTable subproblems;
  MddCache mdds;
  DependencyTable excesses{subproblems};
  // If true, an earlier cache was full, so this one may be dropped as well before its results are
  // used.
  const bool follows_another = false;
  // Unique among all caches of this process.
  const std::int64_t number = next_number();

  // Merges the results of one worker. The order in which workers merge does not matter.
  void merge(const CacheDelta& found);
  // Returns the entries that merge() has added or improved since the last call. Recording starts
  // with the first call, which returns nothing.
  NewEntries take_new_entries();

  // Drops MDDs if there are too many; they can be computed again.
  void trim() { mdds.trim(); }
  std::size_t bytes() const { return subproblems.bytes() + mdds.bytes() + excesses.bytes(); }

 private:
  static std::int64_t next_number();

  std::atomic<bool> keeps_new_entries_{false};
  std::mutex news_mutex_;
  NewEntries news_;
};

// Cache of one worker: the shared cache, and the worker's own results that are not shared yet. The
// worker does not see results of other workers before they are merged into the shared cache.
// Therefore a worker that starts again from the same shared cache repeats the same computations,
// whatever other workers compute concurrently. One thread at a time.
class WorkerCache {
 public:
  using Id = SubproblemTable::Id;

  // `planner` must outlive this object. MDDs of more than `max_set_nodes` nodes are not built.
  WorkerCache(PathPlanner& planner, std::shared_ptr<SharedCache> common, std::int64_t max_set_nodes)
      : planner_(planner), common_(std::move(common)), max_mdd_nodes_(max_set_nodes) {}

  // Removes and returns the results since the last call. This worker sees them again once they are
  // in the shared cache.
  CacheDelta take_delta() { return std::exchange(found_, {}); }
  // Uses this shared cache from now on. If it is a different one, results that were not taken are
  // dropped and all subproblem numbers become invalid.
  void use_shared_cache(std::shared_ptr<SharedCache> common);
  const std::shared_ptr<SharedCache>& common() const { return common_; }
  // Number of the shared cache. Subproblem numbers stay valid as long as this number is the same.
  std::int64_t numbering() const { return common_->number; }

  // id() and known(): like the methods of SubproblemTable. merge() replaces the worker's own entry,
  // so `known` must be at least as strong as known(id).
  Id id(AgentIndex agent, const AgentSequencing& order, std::span<const Constraint> constraints) {
    ++asked_;
    return common_->subproblems.id(agent, order, constraints);
  }
  // Number of subproblem queries so far, and of groups compared in full or looked up.
  std::int64_t asked() const { return asked_; }
  std::int64_t groups_asked() const { return groups_asked_; }
  // Number of MDD queries so far, and of those that the cache answered.
  std::int64_t mdd_queries() const { return sets_asked_; }
  std::int64_t mdd_hits() const { return sets_known_; }
  SubproblemTable::CostBound known(Id id) const;
  void merge(Id id, SubproblemTable::CostBound known) { found_.costs[id] = known; }

  // The MDD of a subproblem, which is built if it is not cached; empty if it or the costs to go
  // would be too large. Returns nullptr if a limit was reached. Valid until take_delta() or
  // use_shared_cache().
  const Mdd* paths(Id id, AgentIndex agent, const AgentSequencing& order,
                   std::span<const Constraint> constraints, Time cost, const Limits& limits);

  // Like the methods of DependencyTable. of_pair() returns the worker's own entry if there is one;
  // call merge_pair() at most once per pair between two calls of take_delta(). partners() and
  // groups_at() report entries in any order, possibly repeatedly.
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
  const std::int64_t max_mdd_nodes_;
  std::int64_t asked_ = 0;
  mutable std::int64_t groups_asked_ = 0;
  std::int64_t sets_asked_ = 0;
  std::int64_t sets_known_ = 0;
  CacheDelta found_;
};

}  // namespace grove::detail
