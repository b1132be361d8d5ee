// SPDX-License-Identifier: MIT
// The components of the engine in one process.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "engine/component.h"
#include "engine/components/tree_search.h"
#include "engine/scheduler.h"
#include "engine/search_memory.h"

namespace grove::detail {

// Each function makes a component of a process. Returns nullptr if the run does not use it.
// components.def registers these functions.
std::unique_ptr<Component> make_tree_search(const ComponentContext& context);
std::unique_ptr<Component> make_primal_component(const ComponentContext& context);
std::unique_ptr<Component> make_tree_preparation(const ComponentContext& context);
std::unique_ptr<Component> make_lagrangian_component(const ComponentContext& context);
std::unique_ptr<Component> make_joint_component(const ComponentContext& context);
std::unique_ptr<Component> make_cores_component(const ComponentContext& context);

// Number of a process within the run, and number of processes.
struct ProcessPlace {
  int rank = 0;
  int ranks = 1;
};

// The components that the options of a run enable, and the data that they share. Thread-safe,
// except where a function says otherwise.
class Components {
 public:
  // All arguments must outlive this object, except `stops`, which is copied. `stops`: the agents'
  // stops computed so far.
  Components(const Problem& problem, const SolveOptions& options, const Limits& limits,
             const AgentStopsCache& stops, LocalNodes& nodes, SharedBounds& bounds,
             TreeSupply& trees, WorkObserver& observer, ProcessPlace place = {});

  const ComponentContext& context() const { return context_; }
  bool over() const { return context_.bounds.over(); }
  SearchMemory& memory() { return memory_; }
  // The tree search, whose nodes ranks send to each other.
  TreeSearch& tree() { return *tree_; }

  // Returns the work for worker number `worker` of the run. Must be called before the search, on
  // one thread.
  std::vector<Scheduler::Entry> sources(int worker);
  // True if there may be work for an idle worker that found none before.
  bool has_work() const;
  // False if no node is live in this process: then a call of the tree search determines whether the
  // next tree is due or the run is over.
  bool has_live_nodes() const { return context_.nodes.frontier.live() > 0; }
  // Frees memory if it is short.
  void keep_within_memory();

  // Adds the counts of this process, except those of its workers.
  void add_counts(Counters& counters) const;
  MemoryUse memory_use() const;
  // Logs what proves the components' bounds. Must be called after the search.
  void log_proof(ProofLog& proof) const;

  // Messages to and from the same components of other processes; see Component. Only the
  // communicating thread may call these functions.
  std::vector<std::pair<int, ComponentMessage>> take_messages();
  void receive(int from, const ComponentMessage& message);

 private:
  const AgentStopsCache stops_;
  SearchMemory memory_;
  SharedResults results_;
  const ComponentContext context_;
  std::vector<std::unique_ptr<Component>> components_;  // by ComponentId; nullptr: not enabled
  TreeSearch* tree_;
};

}  // namespace grove::detail
