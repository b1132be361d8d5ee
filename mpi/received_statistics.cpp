// SPDX-License-Identifier: MIT
#include "mpi/received_statistics.h"

namespace grove::detail {

void ReceivedStatistics::update(const message::ProcessStatistics& report) {
  for (const auto& [rank, statistics] : report.statistics.ranks) latest_[rank] = report.statistics;
}

void ReceivedStatistics::finish(const message::RankFinished& message) {
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
