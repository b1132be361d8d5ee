// SPDX-License-Identifier: MIT
// One worker of a run.
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

// An expander and a primal search, which take turns; and on the first worker of a run a search over
// joint states, where there are few. For one thread at a time, but for what says
// otherwise.
class Worker {
 public:
  // All must outlive this, but for `stops`, of which it makes a copy. `number` from 0; each number
  // looks for plans from another seed.
  Worker(const Problem& problem, const SolveOptions& options, const Limits& limits,
         SharedSearch& shared, const AgentStopsCache& stops, int number);
  ~Worker();

  // What is done at one go, and what became of it.
  struct WorkItem {
    enum class Job : std::uint8_t { kExpand, kHelp, kPrimal, kPrepare, kJoint, kLagrangian };
    explicit WorkItem(Job the_job, NodePtr the_node = nullptr)
        : job(the_job), node(std::move(the_node)) {}

    Job job;
    NodePtr node;                                            // to expand or to help with
    BoundingEffort bounding_effort = BoundingEffort::kFull;  // with which to expand it
    std::shared_ptr<SharedCache> memory;                     // to do so with
    CacheDelta found;
    Expansion expansion;
    std::optional<Plan> plan;
    Cost proven = 0;  // by the search over joint states; see Ledger::prove
    LagrangianBound::Job lagrangian;
    std::int64_t work = 0;   // see search/work.h
    ExpansionCounts counts;  // what this turn added
  };

  // Does the best there is to do: expands a node, helps another worker with one, goes on with the
  // primal search or that over joint states for about a millisecond, finds some prices for the
  // Lagrangian bound, or prepares the next tree.
  // False: nothing can be done just now.
  bool turn() {
    std::optional<WorkItem> turn = choose();
    if (!turn) return false;
    perform(*turn, expander());
    publish(*turn);
    commit(*turn);
    return true;
  }

  // A turn in four parts: settles what to do (none: there is nothing), does it, makes common what
  // was found out, and tells. perform() only reads what is shared; several turns that expand nodes
  // may be performed at the same time, each by another expander. Turns may be published at the
  // same time.
  std::optional<WorkItem> choose();
  void perform(WorkItem& turn, Expander& by);
  static void publish(WorkItem& turn);
  void commit(WorkItem& turn);
  // Its own expander, made when first asked for. Of one thread; not necessarily the worker's.
  Expander& expander();

  // Adds what the turns of this worker that were committed have counted. From any thread.
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
  // Each with what it knows of the agents, for they may be in the hands of different threads. Made
  // when they are first due.
  AgentStopsCache expander_stops_;
  std::unique_ptr<Expander> expander_;
  AgentStopsCache primal_stops_;
  std::unique_ptr<PrimalSearch> primal_;
  const std::unique_ptr<PrimalScheduler> share_;
  const std::unique_ptr<JointScheduler> joint_;
  std::optional<Pricer> pricer_;  // made when it is first due
  NodePtr helped_;                // the last node that there was nothing left to help with

  mutable std::mutex counting_;  // guards what was counted:
  ExpansionCounts of_tree_;
  PrimalSearch::Counts of_primal_;
  std::int64_t helps_ = 0;
  std::int64_t joint_states_ = 0;
};

}  // namespace grove::detail
