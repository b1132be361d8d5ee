// SPDX-License-Identifier: MIT
// The instances of a batch that are left to solve, and those that groups are solving.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "batch/entry.h"
#include "batch/row.h"

namespace grove::detail::batch {

// Each run to do first waits, then is in progress, then is ended. One thread at a time.
class Assignments {
 public:
  // An instance that a group is solving.
  struct InProgress {
    std::string id;
    double since;  // seconds of the caller's clock
  };

  // The runs of `entries` with these settings; none is to do yet.
  Assignments(std::vector<Entry> entries, const Settings& settings);

  // In the order of the entries.
  const std::vector<Run>& runs() const { return runs_; }
  // Sets the runs to do: positions in runs(), in the order in which to do them.
  void set_todo(std::vector<std::size_t> todo);

  std::size_t waiting() const { return todo_.size() - next_; }
  bool any_waiting() const { return waiting() > 0; }
  // By leader of the group.
  const std::map<int, InProgress>& in_progress() const { return in_progress_; }
  // Assigns the next waiting run, which must exist, to the group of `leader`. Returns its position
  // in runs().
  std::size_t start(int leader, double now);
  const Entry& entry(std::size_t run) const { return entries_[run]; }
  // Ends the assignment of `leader`. `id`: the instance that the leader reports; nullptr if it
  // reports none. Throws std::logic_error if this is not the leader's assignment.
  void end(int leader, const std::string* id);

 private:
  const std::vector<Entry> entries_;
  const std::vector<Run> runs_;    // runs of entries_
  std::vector<std::size_t> todo_;  // positions in runs_
  std::size_t next_ = 0;           // position in todo_
  std::map<int, InProgress> in_progress_;
};

}  // namespace grove::detail::batch
