// SPDX-License-Identifier: MIT
#include "mpi/received_statistics.h"

#include "model/assert.h"

namespace grove::detail {

void ReceivedStatistics::update(const message::ProcessStatistics& report) {
  for (const auto& [rank, statistics] : report.statistics.ranks) {
    GROVE_CHECK(!has_finished(rank), "the final statistics of a rank are its last");
    latest_[rank] = report.statistics;
  }
}

void ReceivedStatistics::finish(const message::RankFinished& message) {
  for (const auto& [rank, statistics] : message.statistics.ranks)
    GROVE_CHECK(!has_finished(rank), "a rank finishes once");
  add(message, finished_);
  ++finished_children_;
}

RunStatistics ReceivedStatistics::all() const {
  RunStatistics all = finished_.statistics;
  for (const auto& [rank, statistics] : latest_)
    if (!all.ranks.contains(rank)) add(statistics, all);
  return all;
}

}  // namespace grove::detail
