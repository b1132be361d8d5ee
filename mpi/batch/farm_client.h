// SPDX-License-Identifier: MIT
// Client of the task farm: a rank that, with its group, solves the instances that the master
// assigns.
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

// Solves an instance. The client calls the function on all ranks of the group. On the leader (rank
// 0 of the group) the function fills `row` with the facts of the instance, the outcome and the name
// of the plan file, and writes the plan file before it returns; on other ranks `row` is ignored.
// The function must call `poll` about every millisecond, on the thread that called it, and must
// pass on what `poll` throws. If it throws a std::exception on any rank, the row records that
// error. Ranks that wait for a rank that threw must detect this themselves (gather.h). No rank
// starts the next instance before all ranks of its group have ended this one.
using Solve = std::function<void(const Entry& entry, Row& row, const std::function<void()>& poll)>;

struct ClientOptions {
  Solve solve;
  Settings settings = {};  // settings of all runs
  int threads = 1;         // number of threads of this rank, for the rows
  std::string version = {};
  std::string machine = {};
  BatchClock clock;
  std::function<void()> idle;  // called while there is nothing to do; may sleep briefly
};

// Runs the client side of the farm on one rank. One thread at a time.
class FarmClient {
 public:
  // `world` connects all ranks, `group` the ranks of this rank's group (Grouping), in the same
  // order. No other code may use these transports, so `options.solve` needs one of its own.
  // `interrupted` is the flag that this rank's signal handler sets and its search polls; the client
  // sets it when the master sends Stop. `master`: the master if this is rank 0, else nullptr. All
  // arguments except `options` must outlive this object.
  FarmClient(Transport& world, Transport& group, std::atomic<bool>& interrupted,
             ClientOptions options, FarmMaster* master);

  // Returns when this rank has received NoMoreWork and, on rank 0, the master is done. By then this
  // rank has received every message sent to it. Throws what the master throws.
  void run();

 private:
  void run_as_leader();
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
