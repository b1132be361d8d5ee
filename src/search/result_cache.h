// SPDX-License-Identifier: MIT
// What was found out about agents, pairs and groups in the course of a search.
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

// What one worker found out, until it is common. Values; the numbers are those of one common
// memory.
struct CacheDelta {
  using Id = SubproblemTable::Id;
  struct Pair {
    Id first;
    Id second;
    AgentIndex agent;
    DependencyTable::Known known;
  };
  std::unordered_map<Id, SubproblemTable::Known> costs;
  std::unordered_map<Id, MddCache::Set> sets;  // all that were asked for
  // Few at a time.
  std::vector<Pair> pairs;
  std::vector<DependencyTable::Group> groups;
};

// What workers found out lately that nobody here knew before; see CacheDelta. Values.
struct NewEntries {
  std::vector<std::pair<SubproblemTable::Id, SubproblemTable::Known>> costs;
  std::vector<CacheDelta::Pair> pairs;
  std::vector<DependencyTable::Group> groups;
};

// What all workers know. Thread-safe; nothing is ever taken back, so whoever wants it forgotten
// starts another one.
struct SharedCache {
  SharedCache() = default;
  // Takes the place of one that was full.
  struct Successor {};
  explicit SharedCache(Successor /*successor*/) : follows_another(true) {}

  SubproblemTable situations;
  MddCache path_sets;
  DependencyTable excesses{situations};
  // What is found out may have to be forgotten again before it is of use.
  const bool follows_another = false;
  // Of this one alone among all that there were in this process.
  const std::int64_t number = next_number();

  // Adds this. Workers may do so at the same time: it does not matter who is first.
  void merge(const CacheDelta& found);
  // What was news of that, from the first call on, since the last call.
  NewEntries take_new_entries();

  // Forgets what there is too much of, and can be found again.
  void trim() { path_sets.trim(); }
  std::size_t bytes() const { return situations.bytes() + path_sets.bytes() + excesses.bytes(); }

 private:
  static std::int64_t next_number();

  std::atomic<bool> keeps_new_entries_{false};
  std::mutex news_mutex_;
  NewEntries news_;
};

// What one worker knows: the common memory, and what it has found out that is not common yet. So
// what others find out at the same time does not reach it before it asks, and a worker that is
// given the same common memory does the same again, whatever the others do meanwhile. Of one
// thread.
class WorkerCache {
 public:
  using Id = SubproblemTable::Id;

  // `planner` must outlive this. Sets of optimal paths have `most_set_nodes` or are not made.
  WorkerCache(PathPlanner& planner, std::shared_ptr<SharedCache> common,
              std::int64_t most_set_nodes)
      : planner_(planner), common_(std::move(common)), most_set_nodes_(most_set_nodes) {}

  // Hands over what was found out since the last time; it is not known here any more until it is
  // common.
  CacheDelta take_delta() { return std::exchange(found_, {}); }
  // Turns to this common memory. If it is another one, what was not handed over is forgotten, and
  // so are all numbers.
  void turn_to(std::shared_ptr<SharedCache> common);
  const std::shared_ptr<SharedCache>& common() const { return common_; }
  // Changes with the common memory: numbers of situations are good as long as this is the same.
  std::int64_t numbering() const { return common_->number; }

  // As those of Situations.
  Id id(AgentIndex agent, const AgentSequencing& order, std::span<const Constraint> constraints) {
    ++asked_;
    return common_->situations.id(agent, order, constraints);
  }
  // Situations that were asked about so far, and groups that were looked at for an answer.
  std::int64_t asked() const { return asked_; }
  std::int64_t groups_asked() const { return groups_asked_; }
  // Sets of optimal paths that were asked for so far, and those of them that had been made.
  std::int64_t sets_asked() const { return sets_asked_; }
  std::int64_t sets_known() const { return sets_known_; }
  SubproblemTable::Known known(Id id) const;
  void merge(Id id, SubproblemTable::Known known) { found_.costs[id] = known; }

  // As MddCache::find; valid until take_found().
  const Mdd* paths(Id id, AgentIndex agent, const AgentSequencing& order,
                   std::span<const Constraint> constraints, Time cost, const Limits& limits);

  // As those of Excesses. Partners and groups come in any order, perhaps more than once.
  DependencyTable::Known of_pair(Id first, Id second) const;
  void merge_pair(Id first, Id second, AgentIndex agent, DependencyTable::Known known);
  void partners(Id first, std::vector<DependencyTable::Partner>& partners) const;
  DependencyTable::Known of_group(const std::vector<Id>& situations) const;
  void merge_group(const std::vector<AgentIndex>& agents, const std::vector<Id>& situations,
                   DependencyTable::Known known);
  template <class Use>
  void groups_at(const std::vector<Id>& now, Use use) const {
    groups_asked_ += common_->excesses.groups_at(now, use);
    for (const DependencyTable::Group& group : found_.groups)
      if (group.is_at(now)) use(group);
  }

 private:
  PathPlanner& planner_;
  std::shared_ptr<SharedCache> common_;
  const std::int64_t most_set_nodes_;
  std::int64_t asked_ = 0;
  mutable std::int64_t groups_asked_ = 0;
  std::int64_t sets_asked_ = 0;
  std::int64_t sets_known_ = 0;
  CacheDelta found_;
};

}  // namespace grove::detail
