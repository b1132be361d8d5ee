// SPDX-License-Identifier: MIT
// One worker of a run.
#pragma once

#include <memory>
#include <optional>

#include "grove/engine/solve.h"
#include "grove/primal/primal_search.h"
#include "grove/search/expander.h"
#include "primal_share.h"
#include "shared_search.h"

namespace grove {

// An expander and a primal search with their memories, which take turns. For one thread at a time.
class Worker {
 public:
  // All must outlive this. `number` from 0; each number looks for plans from another seed.
  Worker(const Problem& problem, const SolveOptions& options, const Limits& limits,
         SharedSearch& shared, int number);

  // Does the best there is to do: expands a node, helps another worker with one, goes on with the
  // primal search for about a millisecond, or prepares the next tree. False: nothing can be done
  // just now.
  bool turn() {
    if (!choose()) return false;
    perform();
    commit();
    return true;
  }

  // A turn in three parts, of which perform() only reads what is shared: settles what to do (false:
  // there is nothing), does it, and tells.
  bool choose();
  void perform();
  void commit();

  // Adds what this worker counted to the answer's statistics.
  void add_counts(Stats& stats) const;

 private:
  PrimalSearch& primal();
  void expand();
  void step_primal();
  void help();

  const Problem& problem_;
  const SolveOptions& options_;
  const Limits& limits_;
  SharedSearch& shared_;
  const int number_;
  AgentStopsStore stops_;
  Expander expander_;
  std::unique_ptr<PrimalSearch> primal_;  // made when it is first due
  PrimalShare share_;

  // Of the turn under way.
  enum class Job { kExpand, kHelp, kPrimal, kPrepare };
  Job job_ = Job::kExpand;
  NodePtr node_;  // to expand or to help with
  Expansion expansion_;
  std::optional<Plan> plan_;
  std::int64_t work_ = 0;
  NodePtr helped_;  // the last node that there was nothing left to help with
  std::int64_t helps_ = 0;
};

}  // namespace grove
