// SPDX-License-Identifier: MIT
// Hands out the instances of a batch and collects the rows.
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "batch/batch_clock.h"
#include "batch/entry.h"
#include "batch/result_table.h"
#include "mpi/batch/batch_progress.h"
#include "mpi/batch/farm_messages.h"
#include "mpi/batch/grouping.h"
#include "mpi/transport.h"

namespace grove::detail::batch {

struct MasterOptions {
  Settings settings;  // of all runs
  // Since the master was made. Then nothing more is handed out; what is under way goes on.
  double total_time_limit_s = std::numeric_limits<double>::infinity();
  // Told at every poll(); may be empty.
  std::function<void(const BatchState&)> watch = {};
};

// Lives on rank 0 of the world beside that rank's FarmClient, which polls it: everything that
// arrives there arrives here first. Instances are handed out one at a time, in the table's order,
// to the group that asks; a row is on disk before its group gets the next. When `interrupted` is
// set, here or at a leader, nothing more is handed out, all groups are told, and what they then
// give up leaves no row. Of one thread.
class FarmMaster {
 public:
  // Begins `table` with `entries`. `world`, `table` and `interrupted` must outlive this.
  FarmMaster(Transport& world, Grouping grouping, std::vector<Entry> entries, ResultTable& table,
             std::atomic<bool>& interrupted, BatchClock clock, MasterOptions options);

  // Does what there is to do and never waits for messages; a row costs a write to disk. To be
  // called about every millisecond. Throws InputError when the table cannot be written, and
  // std::logic_error when a leader breaks the rules.
  void poll();
  // Every group was dismissed, and the table is complete; no more poll() is needed.
  bool done() const { return dismissed_ == grouping_.groups(); }

  BatchState state() const;
  // Was the batch interrupted?
  bool interrupted() const { return stopping_; }
  // How many instances have no row, neither a result nor an error.
  int left() const { return state_.total - state_.done(); }

  // The next message for the leader on this rank.
  std::optional<FarmMessage> take_own();

 private:
  struct UnderWay {
    std::string id;
    double since;
  };

  void on(int from, RequestWork&);
  void on(int from, Report& report);
  void on(int from, Aborted&);
  template <typename Other>
  void on(int from, Other&);

  void end_assignment(int leader, const std::string* id);
  void tell(int leader, FarmMessage message);
  void stop_if_interrupted();
  void record();
  void answer();
  bool has_work() const;
  void assign_next(int leader);
  double seconds() const { return clock_.seconds() - start_; }

  Transport& world_;
  const Grouping grouping_;
  ResultTable& table_;
  std::atomic<bool>& interrupted_;
  const BatchClock clock_;
  const MasterOptions options_;
  const double start_;
  const std::vector<Entry> entries_;
  const std::vector<Run> runs_;          // of entries_
  const std::vector<std::size_t> todo_;  // of runs_
  std::size_t next_ = 0;                 // of todo_
  std::map<int, UnderWay> under_way_;    // by leader
  std::vector<Row> finished_;            // not yet on disk
  std::deque<int> asking_;               // leaders
  std::deque<FarmMessage> own_;          // for the leader on this rank
  BatchState state_;                     // what can be counted
  bool stopping_ = false;
  int dismissed_ = 0;
  double next_csv_s_ = 0;
};

}  // namespace grove::detail::batch
