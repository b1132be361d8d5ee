// SPDX-License-Identifier: MIT
// The bound ledger, as those see it who expand nodes, and the nodes, as the ledger sees them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "grove/model/plan.h"
#include "grove/primal/plan_source.h"
#include "grove/search/expander.h"
#include "grove/search/node.h"

namespace grove {

// What a run has proven and found, as far as this process knows. The ledger itself is a
// CentralLedger; where it is in another process, what was last heard of it. Methods may be called
// from any thread and do not wait.
class Ledger {
 public:
  Ledger() = default;
  Ledger(const Ledger&) = delete;
  Ledger& operator=(const Ledger&) = delete;
  virtual ~Ledger() = default;

  // Is there nothing left to do, or no time to do it?
  virtual bool over() const = 0;
  // Nodes that cost so much or more are of no use, for a plan that was checked costs that.
  virtual Cost cutoff() const = 0;
  // That plan if it is cheaper than `cost`.
  virtual std::optional<Plan> plan_below(Cost cost) const = 0;
  // No plan costs less.
  virtual Cost lower_bound() const = 0;

  // A plan was found.
  virtual void post(Plan plan, PlanSource source) = 0;
  // Nodes were replaced by what they led to.
  virtual void nodes_changed() = 0;
  // For observers: a node led to this, these nodes were given up, some work was done.
  virtual void expanded(const NodePtr& node, const Expansion& expansion) = 0;
  virtual void evicted(std::span<const NodePtr> nodes) = 0;
  virtual void worked() = 0;

  // Before a node is taken: brings the next tree where Algorithm 4 finds that necessary.
  virtual void bring_due_tree() = 0;
  // No node is live here: brings nodes or finds that there are none, unless that is not for this
  // process to say.
  virtual void bring_nodes() = 0;
  // May the caller prepare the next tree before Algorithm 4 asks for it? Whoever is told so must do
  // it. One at a time.
  virtual bool claim_preparation() = 0;
  virtual void prepare_tree() = 0;
};

// Where the live nodes of a run are: in one frontier, or with many ranks.
class LiveNodes {
 public:
  struct Counts {
    std::int64_t expanded = 0;
    std::int64_t open = 0;
  };

  LiveNodes() = default;
  LiveNodes(const LiveNodes&) = delete;
  LiveNodes& operator=(const LiveNodes&) = delete;
  virtual ~LiveNodes() = default;

  // No plan in a live node, or in one that was given up, costs less.
  virtual Cost bound() const = 0;
  // The least bound of those given up.
  virtual Cost evicted_bound() const = 0;
  // False only if no node is live.
  virtual bool any() const = 0;
  virtual Counts counts() const = 0;

  virtual void push(const NodePtr& root) = 0;
  // Drops nodes whose bound is at least `cost`, which a checked plan costs.
  virtual void prune(Cost cost) = 0;
  // See Frontier::restart().
  virtual void restart(std::span<const NodePtr> roots, Cost proven) = 0;
};

}  // namespace grove
