// SPDX-License-Identifier: MIT
// The worker of a simulated rank.
#pragma once

#include <cstdint>

#include "grove/engine/shared_search.h"
#include "grove/model/limits.h"
#include "grove/search/expander.h"
#include "mpi/simulator/machine.h"

namespace grove {

// Does what a Worker does that never looks for plans beside the tree: takes a node, expands it and
// brings back what it led to. Between the two simulated time passes. Of one thread.
class SimulatedWorker {
 public:
  struct Tally {
    std::int64_t turns = 0;
    double work = 0;          // in units of about one label of the low level
    double busy_s = 0;        // simulated
    double processor_s = 0;   // that it really took
    double first_turn_s = 0;  // if any: when it began
  };

  // All must outlive this.
  SimulatedWorker(SharedSearch& search, const Limits& limits, const Machine& machine)
      : search_(search), limits_(limits), machine_(machine) {}

  // Takes a node if there is one, and expands it: it is busy then. The expander is any one of the
  // same problem.
  void begin(double now, Expander& expander);
  bool busy() const { return static_cast<bool>(node_); }
  // Of the present turn, or the last.
  double began() const { return began_; }
  double busy_until() const { return busy_until_; }
  // Brings back what it led to.
  void end();
  // The same before its time, for the end of a run: it led to nothing.
  void abandon(double now);

  const Tally& tally() const { return tally_; }

 private:
  SharedSearch& search_;
  const Limits& limits_;
  const Machine& machine_;
  NodePtr node_;  // null: not busy
  Expansion expansion_;
  double began_ = 0;
  double busy_until_ = 0;
  Tally tally_;
};

}  // namespace grove
