// SPDX-License-Identifier: MIT
// Worker of a run, which performs one work item after the other.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "engine/shared_search.h"
#include "engine/solve.h"
#include "primal/primal_search.h"
#include "search/expander.h"

namespace grove::detail {

class JointScheduler;
class PrimalScheduler;

// Has an expander and a primal search. Worker 0 also has the search over joint states, for
// instances with few joint states. One thread at a time, except where a function says otherwise.
class Worker {
 public:
  // All arguments must outlive this object, except `stops`, which is copied. `number`: number of
  // the worker, from 0; also selects the seed of its primal search.
  Worker(const Problem& problem, const SolveOptions& options, const Limits& limits,
         SharedSearch& shared, const AgentStopsCache& stops, int number);
  ~Worker();

  // One unit of scheduling, and its result.
  struct WorkItem {
    enum class Job : std::uint8_t { kExpand, kHelp, kPrimal, kPrepare, kJoint, kLagrangian };
    explicit WorkItem(Job the_job, NodePtr the_node = nullptr)
        : job(the_job), node(std::move(the_node)) {}

    Job job;
    NodePtr node;                                            // to expand or to assist with
    BoundingEffort bounding_effort = BoundingEffort::kFull;  // used for expanding it
    std::shared_ptr<SharedCache> memory;                     // shared cache to use
    CacheDelta found;
    Expansion expansion;
    std::optional<Plan> plan;
    Cost proven = 0;  // bound by the joint search; see SharedBounds::prove()
    LagrangianBound::Job lagrangian;
    std::int64_t work = 0;   // effort; see model/effort.h
    ExpansionCounts counts;  // counts added by this item
  };

  // Chooses and completes one work item: expands a node, assists another worker with its node, runs
  // the primal or the joint search for about a millisecond, solves some pricing problems of the
  // Lagrangian bound, or prepares the next tree. Returns false if no work item is available.
  bool turn() {
    std::optional<WorkItem> turn = choose();
    if (!turn) return false;
    perform(*turn, expander());
    publish(*turn);
    commit(*turn);
    return true;
  }

  // The four parts of turn(). choose() selects an item and returns nullopt if none is available.
  // perform() does the work of the item; for an item that expands a node or assists, it only reads
  // shared data. publish() merges the item's new cache entries into the shared cache. commit()
  // posts the item's results. Several items that expand nodes can be performed concurrently, each
  // by a different expander. publish() is thread-safe.
  std::optional<WorkItem> choose();
  void perform(WorkItem& turn, Expander& by);
  static void publish(WorkItem& turn);
  void commit(WorkItem& turn);
  // The worker's own expander, made on first use. One thread at a time, which need not be the
  // worker's thread.
  Expander& expander();

  // Adds the counts of all committed items. Thread-safe.
  void add_counts(Stats& stats) const;

 private:
  PrimalSearch& primal();
  void count(const WorkItem& turn);
  void expand(WorkItem& turn, Expander& by) const;
  void help(WorkItem& turn, Expander& by);
  void step_primal(WorkItem& turn);
  void step_joint(WorkItem& turn);
  void step_lagrangian(WorkItem& turn);
  void add_other_work(std::int64_t work);

  const Problem& problem_;
  const SolveOptions& options_;
  const Limits& limits_;
  SharedSearch& shared_;
  const int number_;
  // The expander and the primal search are made when first due. Each has its own cache, because
  // different threads can use them.
  AgentStopsCache expander_stops_;
  std::unique_ptr<Expander> expander_;
  AgentStopsCache primal_stops_;
  std::unique_ptr<PrimalSearch> primal_;
  const std::unique_ptr<PrimalScheduler> share_;
  const std::unique_ptr<JointScheduler> joint_;
  std::optional<Pricer> pricer_;  // made when first due
  NodePtr helped_;                // last node for which there was nothing left to assist with

  mutable std::mutex counting_;  // guards the counts below
  ExpansionCounts of_tree_;
  PrimalSearch::Counts of_primal_;
  std::int64_t helps_ = 0;
  std::int64_t joint_states_ = 0;
};

}  // namespace grove::detail
