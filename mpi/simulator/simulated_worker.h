// SPDX-License-Identifier: MIT
// The worker of a simulated rank.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/worker.h"
#include "mpi/simulator/machine.h"
#include "mpi/simulator/mdd_interner.h"

namespace grove::detail {

// Plays a worker's turns on a simulated clock: between what a turn chooses and does and what others
// see of it time passes, by its work. Of one thread.
class SimulatedWorker {
 public:
  struct Tally {
    std::int64_t turns = 0;
    double work = 0;          // see search/work.h
    double busy_s = 0;        // simulated
    double processor_s = 0;   // that it really took
    double first_turn_s = 0;  // if any: when it began
  };

  // All must outlive this. `sets`: of all workers.
  SimulatedWorker(Worker& worker, const Machine& machine, MddInterner& sets)
      : worker_(worker), machine_(machine), sets_(sets) {}

  // Begins a turn if there is anything to do: it is busy then. The expander is any one of the same
  // problem, and used as if it were this worker's own.
  void begin(double now, Expander& expander);
  bool busy() const { return turn_.has_value(); }
  // Of the present turn, or the last.
  double began() const { return began_; }
  double busy_until() const { return busy_until_; }
  // Brings back what it led to.
  void end();
  // The same before its time, for the end of a run: it led to nothing.
  void abandon(double now);

  const Tally& tally() const { return tally_; }

 private:
  Worker& worker_;
  const Machine& machine_;
  MddInterner& sets_;
  std::optional<Worker::WorkItem> turn_;  // none: not busy
  Expander::Kept kept_;                   // as an expander of its own would
  double began_ = 0;
  double busy_until_ = 0;
  Tally tally_;
};

}  // namespace grove::detail
