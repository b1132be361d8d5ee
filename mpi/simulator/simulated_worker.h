// SPDX-License-Identifier: MIT
// Worker of a simulated rank, and the table of MDDs that all simulated workers share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>

#include "engine/worker.h"
#include "mpi/simulator/machine.h"
#include "search/mdd_cache.h"

namespace grove::detail {

// Stores equal MDDs of all simulated ranks once. Each rank builds the MDDs that it needs, and most
// ranks need the same ones. Saves two fifths of the memory with 128 simulated ranks, and a quarter
// with 1,024 ranks (room-32-32-4, 22 agents, 40 tasks). One thread at a time.
class MddInterner {
 public:
  // Returns a stored MDD that equals `set` and is still in use. If there is none, stores and
  // returns `set`.
  MddCache::Set one_of(const MddCache::Set& set);

  std::size_t size() const { return mdds_.size(); }

 private:
  void forget_unused();

  std::unordered_multimap<std::uint64_t, std::weak_ptr<const Mdd>> mdds_;  // by hash
  std::size_t cleanup_size_ = 1000;
};

// Runs a worker's work items on a simulated clock. The results of an item become visible to other
// ranks only after its simulated duration (Machine::seconds_per_work). One thread at a time.
class SimulatedWorker {
 public:
  struct Tally {
    std::int64_t turns = 0;
    double work = 0;          // effort; see model/effort.h
    double busy_s = 0;        // simulated seconds
    double processor_s = 0;   // real processor time
    double first_turn_s = 0;  // start of the first work item, if any, in simulated seconds
  };

  // All arguments must outlive this object. `sets` is shared by all workers.
  SimulatedWorker(Worker& worker, const Machine& machine, MddInterner& sets)
      : worker_(worker), machine_(machine), mdds_(sets) {}

  // Starts a work item if the worker has one; then busy() is true until end() or abandon().
  // `expander` can be any expander of the same problem; it is used as if it were this worker's own.
  void begin(double now, Expander& expander);
  bool busy() const { return item_ != nullptr; }
  // Start and end of the current or last work item, in simulated seconds.
  double began() const { return began_; }
  double busy_until() const { return busy_until_; }
  // Ends the work item and commits its results.
  void end();
  // Ends the work item at `now`, without results, because the run ends.
  void abandon(double now);

  const Tally& tally() const { return tally_; }

 private:
  Worker& worker_;
  const Machine& machine_;
  MddInterner& mdds_;
  std::unique_ptr<WorkItem> item_;      // nullptr: not busy
  Expander::AgentCaches agent_caches_;  // per-agent data that the worker's own expander would keep
  double began_ = 0;
  double busy_until_ = 0;
  Tally tally_;
};

// Processor time of the calling thread, in seconds.
double processor_time();

}  // namespace grove::detail
