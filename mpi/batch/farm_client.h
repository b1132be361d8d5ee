// SPDX-License-Identifier: MIT
// A rank's part in a batch: solves with its group what the master hands out.
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

// Solves an instance; called on all ranks of the group together. What it says in `row` - facts,
// outcome, plan file - counts on the leader, which is rank 0 of the group. It writes the plan file
// before it returns. `poll` must be
// called about every millisecond, from the thread that called; what it throws must be passed on. An
// exception (std::exception) on any rank makes a row with that error; ranks that wait for one that
// threw must come to know of it by themselves (gather.h). No rank begins the next instance before
// all ranks of its group have ended this one.
using Solve = std::function<void(const Entry& entry, Row& row, const std::function<void()>& poll)>;

struct ClientOptions {
  Solve solve;
  Settings settings = {};  // of all runs
  int threads = 1;         // of this rank, for the rows
  std::string version = {};
  std::string machine = {};
  BatchClock clock;
  std::function<void()> idle;  // called while there is nothing to do: sleeps for a moment, say
};

// Of one thread.
class FarmClient {
 public:
  // `world` is all ranks, `group` those of this rank's group (Grouping), in the same order; the
  // farm alone uses them, so `options.solve` needs a transport of its own. `interrupted` is the
  // flag that this rank's signal handler sets and that its search watches; the client sets it when
  // the master says so. `master` is the one on this rank; null on all ranks but 0. All must outlive
  // this.
  FarmClient(Transport& world, Transport& group, std::atomic<bool>& interrupted,
             ClientOptions options, FarmMaster* master);

  // Returns when this rank is dismissed, with a master when that is done; every message sent to
  // this rank has then been received. Throws what the master throws.
  void run();

 private:
  void lead();
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
  std::exception_ptr broken_;  // what poll() threw
};

}  // namespace grove::detail::batch
