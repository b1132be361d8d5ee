// SPDX-License-Identifier: MIT
// Statistics that the coordinator has received from the ranks.
#pragma once

#include <cstdint>
#include <iterator>
#include <map>

#include "engine/run_statistics.h"
#include "mpi/messages.h"

namespace grove::detail {

// The latest statistics of each rank, and the final ones of the ranks that have finished. One
// thread at a time.
class ReceivedStatistics {
 public:
  void update(const message::ProcessStatistics& report);
  // Handles the last message of a child.
  void finish(const message::RankFinished& message);

  // Number of children that have finished.
  int finished_children() const { return finished_children_; }
  // True if `rank` has finished.
  bool has_finished(int rank) const { return finished_.statistics.ranks.contains(rank); }
  std::int64_t finished_ranks() const { return std::ssize(finished_.statistics.ranks); }
  // By receiving rank: number of messages that the finished ranks have sent to it directly.
  const std::map<std::int32_t, std::int64_t>& messages() const { return finished_.messages; }

  // Returns the final statistics of the ranks that have finished and the latest statistics of the
  // others. (A simulated run that reaches a limit ends without RankFinished.)
  RunStatistics all() const;

 private:
  int finished_children_ = 0;
  message::RankFinished finished_;       // sum over the children that have finished
  std::map<int, RunStatistics> latest_;  // by rank: the latest ones before its RankFinished
};

}  // namespace grove::detail
