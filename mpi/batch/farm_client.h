// SPDX-License-Identifier: MIT
// A rank of a batch: solves with its group the instances that the master assigns.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <optional>
#include <string>

#include "batch/batch_clock.h"
#include "batch/entry.h"
#include "mpi/batch/farm_master.h"
#include "mpi/batch/farm_messages.h"
#include "mpi/transport.h"

namespace grove::detail::batch {

// Solves an instance. Called on all ranks of the group together. Only the `row` of the leader, rank
// 0 of the group, counts: it gets the facts of the instance, the outcome and the plan file. The
// plan file is written before the function returns. The function must call `poll` about every
// millisecond, from the thread that called it, and must pass on what `poll` throws. A
// std::exception on any rank makes a row with that error. Ranks that wait for a rank that threw
// must detect this themselves (gather.h). No rank begins the next instance before all ranks of its
// group have ended this one.
using Solve = std::function<void(const Entry& entry, Row& row, const std::function<void()>& poll)>;

struct ClientOptions {
  Solve solve;
  Settings settings = {};  // of all runs
  int threads = 1;         // threads of this rank, for the rows
  std::string version = {};
  std::string machine = {};
  BatchClock clock;
  std::function<void()> idle;  // called while there is nothing to do; it may sleep for a moment
};

// One thread at a time.
class FarmClient {
 public:
  // `world` connects all ranks, `group` those of this rank's group (Grouping), in the same order.
  // Only the farm uses them, so `options.solve` needs a transport of its own. `interrupted` is the
  // flag that this rank's signal handler sets and that its search polls. The client sets it when
  // the master sends Stop. `master` is the one on this rank; nullptr on all ranks except 0. All
  // arguments must outlive this.
  FarmClient(Transport& world, Transport& group, std::atomic<bool>& interrupted,
             ClientOptions options, FarmMaster* master);

  // Returns when this rank has received NoMoreWork; on the rank of the master, when the master is
  // done too. Every message sent to this rank has been received then. Throws what the master
  // throws.
  void run();

 private:
  void run_as_master();
  void follow();
  std::optional<Entry> next_entry();
  Row solve(const Entry& entry);
  void poll();
  void wait_for_members(Row& row);
  void tell_master(const FarmMessage& message);
  void tell_members(const FarmMessage& message);
  std::optional<FarmMessage> receive_from_master();
  std::optional<FarmMessage> receive_from_group();

  Transport& world_;
  Transport& group_;
  std::atomic<bool>& interrupted_;
  const ClientOptions options_;
  FarmMaster* const master_;
  std::exception_ptr broken_;  // exception of poll()
};

}  // namespace grove::detail::batch
