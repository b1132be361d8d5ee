// SPDX-License-Identifier: MIT
// Assigns the instances of a batch to groups of ranks and collects the rows.
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "batch/batch_clock.h"
#include "batch/entry.h"
#include "batch/result_table.h"
#include "batch/table_writer.h"
#include "mpi/batch/assignments.h"
#include "mpi/batch/batch_progress.h"
#include "mpi/batch/farm_messages.h"
#include "mpi/transport.h"

namespace grove::detail::batch {

// Partitions the ranks of the world into groups of `per_group` consecutive ranks; the last group
// may be smaller. The first rank of each group is its leader. Both numbers are >= 1.
struct Grouping {
  int ranks = 1;
  int per_group = 1;

  int groups() const { return (ranks + per_group - 1) / per_group; }
  int group_of(int rank) const { return rank / per_group; }
  int rank_in_group(int rank) const { return rank % per_group; }
};

struct MasterOptions {
  Settings settings;  // settings of all runs
  // Seconds from the construction of the master after which it assigns no further instance.
  // Instances in progress continue.
  double total_time_limit_s = std::numeric_limits<double>::infinity();
  // Called at every poll(); may be empty.
  std::function<void(const BatchState&)> watch = {};
};

// Runs on rank 0 of the world. That rank's FarmClient calls poll(), and receives all messages to
// that rank through the master. The master assigns one instance at a time, in the order of the
// table, to a group that requests work. A row is on disk before its group gets the next instance.
// When `interrupted` is set, here or at a leader, the master assigns no further instance and sends
// Stop to the groups with an instance in progress. An instance that a group then aborts leaves no
// row. One thread at a time.
class FarmMaster {
 public:
  // Starts `table` with `entries`. `world`, `table` and `interrupted` must outlive this object.
  FarmMaster(Transport& world, Grouping grouping, std::vector<Entry> entries, ResultTable& table,
             std::atomic<bool>& interrupted, BatchClock clock, MasterOptions options);

  // Handles the messages that have arrived and replies to them; never waits for messages. Writes
  // each new row to disk. Must be called about every millisecond. Throws InputError if the table
  // cannot be written, and std::logic_error if a leader violates the protocol.
  void poll();
  // True if the master has sent NoMoreWork to every group and the table is complete. poll() is then
  // no longer needed.
  bool done() const { return dismissed_ == state_.groups; }

  BatchState state() const;
  // True if the batch was interrupted.
  bool interrupted() const { return stopping_; }
  // Number of instances that have no row yet, neither with a result nor with an error.
  int left() const { return state_.total - state_.done(); }

  // Returns the next message for the leader on this rank, or nullopt if there is none.
  std::optional<FarmMessage> take_own_message();

 private:
  void on(int from, RequestWork&);
  void on(int from, Report& report);
  void on(int from, Aborted&);
  template <typename Other>
  void on(int from, Other&);

  void send(int leader, FarmMessage message);
  void stop_if_interrupted();
  void record();
  void check_runs() const;
  void answer();
  bool has_work() const;
  void assign_next(int leader);
  double seconds() const { return clock_.seconds() - start_; }

  Transport& world_;
  ResultTable& table_;
  std::atomic<bool>& interrupted_;
  const BatchClock clock_;
  const MasterOptions options_;
  const double start_;
  Assignments assignments_;
  TableWriter writer_;
  std::vector<Row> finished_;    // rows not yet on disk
  std::deque<int> asking_;       // leaders that wait for an assignment
  std::deque<FarmMessage> own_;  // messages for the leader on this rank
  BatchState state_;             // without the fields that state() sets
  bool stopping_ = false;
  int dismissed_ = 0;
};

}  // namespace grove::detail::batch
