// SPDX-License-Identifier: MIT
// Worker of a simulated rank, and the MDDs that all simulated workers share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>

#include "engine/worker.h"
#include "mpi/simulator/machine.h"
#include "search/mdd_cache.h"

namespace grove::detail {

// Each rank builds the MDDs that it needs itself, and most ranks need the same MDDs. Storing equal
// MDDs once saves two fifths of the memory of 128 simulated ranks, and a quarter with 1,024 ranks
// (room-32-32-4, 22 agents, 40 tasks). One thread at a time.
class MddInterner {
 public:
  // Returns an equal stored MDD that is still in use. If there is none, stores and returns `set`.
  MddCache::Set one_of(const MddCache::Set& set);

  std::size_t size() const { return sets_.size(); }

 private:
  void forget_unused();

  std::unordered_multimap<std::uint64_t, std::weak_ptr<const Mdd>> sets_;  // by hash
  std::size_t many_ = 1000;
};

// Runs a worker's work items on a simulated clock. The results of an item are visible to other
// ranks only after its simulated duration (Machine::seconds_per_work). One thread at a time.
class SimulatedWorker {
 public:
  struct Tally {
    std::int64_t turns = 0;
    double work = 0;          // see search/work.h
    double busy_s = 0;        // simulated seconds
    double processor_s = 0;   // real processor time
    double first_turn_s = 0;  // when the first work item began, if any
  };

  // All arguments must outlive this. `sets` is shared by all workers.
  SimulatedWorker(Worker& worker, const Machine& machine, MddInterner& sets)
      : worker_(worker), machine_(machine), sets_(sets) {}

  // Begins a work item if there is one; then the worker is busy. `expander` may be any expander of
  // the same problem. It is used as if it were this worker's own.
  void begin(double now, Expander& expander);
  bool busy() const { return turn_.has_value(); }
  // Start and end of the current or last work item, in simulated seconds.
  double began() const { return began_; }
  double busy_until() const { return busy_until_; }
  // Ends the work item and commits its results.
  void end();
  // Ends the work item early, without results, at the end of a run.
  void abandon(double now);

  const Tally& tally() const { return tally_; }

 private:
  Worker& worker_;
  const Machine& machine_;
  MddInterner& sets_;
  std::optional<Worker::WorkItem> turn_;  // nullopt: not busy
  Expander::AgentCaches agent_caches_;    // per-agent data that an expander of its own would keep
  double began_ = 0;
  double busy_until_ = 0;
  Tally tally_;
};

// Processor time of the calling thread, in seconds.
double processor_time();

}  // namespace grove::detail
