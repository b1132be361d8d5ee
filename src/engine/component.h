// SPDX-License-Identifier: MIT
// Interface of the components of the engine: the parts of a run that share the workers' time. A
// recipe for a new component is in src/README.md.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/component_id.h"
#include "engine/effort_account.h"
#include "engine/live_nodes.h"
#include "engine/run_observer.h"
#include "engine/shared_bounds.h"
#include "engine/solve.h"
#include "engine/tree_supply.h"
#include "lagrangian/dual_solution.h"
#include "model/counters.h"
#include "model/limits.h"
#include "planning/agent_stops_cache.h"
#include "planning/problem.h"
#include "search/expander.h"

namespace grove::detail {

class SearchMemory;

// Objects that only the work items of one worker use. One thread at a time.
class Workspace {
 public:
  Workspace() = default;
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
  virtual ~Workspace() = default;

  virtual Expander& expander() = 0;
};

// Unit of scheduling, of about a millisecond. The worker, or the loop that drives the workers,
// calls perform(), publish() and commit(), in this order.
class WorkItem {
 public:
  WorkItem() = default;
  WorkItem(const WorkItem&) = delete;
  WorkItem& operator=(const WorkItem&) = delete;
  virtual ~WorkItem() = default;

  // Name of this kind of item, for logs and tests.
  virtual std::string_view name() const = 0;
  // Does the work. Reads shared data, but changes only the workspace and data of the component that
  // no other item in progress uses, so that items can be performed concurrently. Any thread.
  virtual void perform(Workspace& workspace) = 0;
  // Makes new cached results visible to other workers. Thread-safe.
  virtual void publish() {}
  // Posts plans and bounds (SharedBounds), and makes all other results visible.
  virtual void commit() = 0;
  // Must be called before commit() if the run ends while perform() is in progress, in simulated
  // time. An item that has taken a node then returns the node in commit().
  virtual void abandon() {}

  // Effort of perform(), by which the engine divides its time; see engine/scheduler.cpp.
  std::int64_t effort() const { return effort_; }
  // Estimated duration of perform(), in the unit of effort, for simulations.
  double duration() const { return duration_; }

  // For deterministic runs, in which a worker has several items in a round: true if the worker may
  // choose its next item before this one is committed.
  virtual bool allows_next() const { return false; }
  // True if the item takes long, so that a round should start with it.
  virtual bool is_long() const { return false; }
  // Cached results that publish() will add; nullptr if there are none.
  virtual CacheDelta* new_results() { return nullptr; }

 protected:
  void set_effort(std::int64_t effort, double duration) {
    effort_ = effort;
    duration_ = duration;
  }

 private:
  friend class Scheduler;

  std::int64_t effort_ = 0;
  double duration_ = 0;
  std::size_t entry_ = 0;  // index of the component's entry in the scheduler
};

// How urgently a component needs effort; see engine/scheduler.cpp.
struct Claim {
  bool is_open = false;    // it can use the effort that it has earned
  bool is_urgent = false;  // it needs effort even if it has not earned any
};

// Effort that a component asks for per unit of effort of lower tiers; see engine/scheduler.cpp.
struct Share {
  double wanted = 0;
  double floor = 0;
  double cap = 0;
};

// A component's work for one worker. One thread at a time.
class WorkSource {
 public:
  // `account` must outlive this object; workers can share it.
  explicit WorkSource(EffortAccount& account) : account_(account) {}
  WorkSource(const WorkSource&) = delete;
  WorkSource& operator=(const WorkSource&) = delete;
  virtual ~WorkSource() = default;

  // Effort of lower tiers before the component gets its first turn.
  virtual std::int64_t start_effort() const { return 0; }
  // Called only once the effort of lower tiers has reached start_effort().
  virtual Claim claim() { return {}; }
  // `lower_tier_effort`: effort of lower tiers so far.
  virtual Share share(std::int64_t /*lower_tier_effort*/) { return {}; }
  // Returns a work item, or nullptr if there is none now.
  virtual std::unique_ptr<WorkItem> next() = 0;
  // False if the component does not pay for the item that it has just committed.
  virtual bool pays() const { return true; }
  // True if a worker that has nothing else to do may call next() even if the component is not due.
  virtual bool uses_idle_time() const { return true; }

  // Adds the counts of the committed items of this worker. Any thread.
  virtual void add_counts(Counters& /*counters*/) const {}

  EffortAccount& account() { return account_; }

 private:
  EffortAccount& account_;
};

// Tiers of components. A component earns effort in proportion to the effort of lower tiers.
enum class EffortTier : std::uint8_t {
  kTree,    // gets the effort that the others leave
  kPrimal,  // finds plans
  kBound,   // proves bounds outside the tree search
};

// Message of a component to the same component in another process. A value type.
struct ComponentMessage {
  ComponentId component{};
  std::string bytes;
};

// A component in one process of a run. Thread-safe, except where a function says otherwise.
//
// Checkpoints contain the nodes, the incumbent and the lower bound. A resumed run rebuilds all
// other state of components.
class Component {
 public:
  Component() = default;
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;
  virtual ~Component() = default;

  virtual EffortTier tier() const = 0;
  // Returns the work for a worker; nullptr if this worker gets none. `worker`: number of the worker
  // within the run, from 0. Called before the search, on one thread.
  virtual std::unique_ptr<WorkSource> source(int worker) = 0;
  // True if there may be work for an idle worker that found none before.
  virtual bool has_work() const { return false; }

  // Adds the counts of this process, except those of WorkSource::add_counts().
  virtual void add_counts(Counters& /*counters*/) const {}
  // Adds the memory that the component holds, by kind. (The tree search adds nodes and caches.)
  virtual void add_memory(MemoryUse& /*memory*/) const {}
  // Frees memory if the process is short of it. Called between work items.
  virtual void keep_within_memory() {}
  // Logs what proves the component's bound. Called after the search.
  virtual void log_proof(ProofLog& /*proof*/) const {}

  // With several ranks: returns the messages to send now, each with its receiver, and handles a
  // message from another rank. receive() throws std::invalid_argument if the message is invalid.
  // Only the communicating thread may call these functions.
  virtual std::vector<std::pair<int, ComponentMessage>> take_messages() { return {}; }
  virtual void receive(int from, const ComponentMessage& message);
};

// Results that components in one process offer to each other. Thread-safe.
class SharedResults {
 public:
  // The latest dual solution of the Lagrangian bound; nullptr if there is none yet.
  std::shared_ptr<const DualSolution> dual_solution() const {
    const std::lock_guard lock(mutex_);
    return dual_solution_;
  }
  // The first tree, which holds all plans if the policy is free; nullptr: none of its nodes was
  // expanded yet. Must outlive this object.
  const Tree* first_tree() const { return first_tree_; }
  void set_first_tree(const Tree& tree) { first_tree_ = &tree; }
  void set_dual_solution(std::shared_ptr<const DualSolution> solution) {
    const std::lock_guard lock(mutex_);
    dual_solution_ = std::move(solution);
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const DualSolution> dual_solution_;
  std::atomic<const Tree*> first_tree_ = nullptr;
};

// `bytes`, or a quarter of the memory limit if that is less: memory for a bound outside the tree
// search.
inline std::size_t at_most_a_quarter(std::size_t bytes, const Limits& limits) {
  const auto limit = limits.memory_limit();
  return limit ? std::min(bytes, *limit / 4) : bytes;
}

// Data and interfaces that the engine gives to each component. All references outlive the
// component.
struct ComponentContext {
  const Problem& problem;
  const SolveOptions& options;
  const Limits& limits;
  const AgentStopsCache& stops;  // the agents' stops computed before the search, to be copied
  SharedBounds& bounds;
  LocalNodes& nodes;
  SearchMemory& memory;
  TreeSupply& trees;
  WorkObserver& observer;
  SharedResults& results;
  int rank = 0;
  int ranks = 1;
};

}  // namespace grove::detail
