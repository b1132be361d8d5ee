// SPDX-License-Identifier: MIT
// Writes rows to a result table. Limits how often it flushes and how often it rewrites the CSV
// file.
#pragma once

#include <functional>
#include <span>
#include <utility>

#include "batch/result_table.h"

namespace grove::detail::batch {

// Minimum intervals in seconds. 0: at every write.
struct WriteIntervals {
  double flush_s = 0;  // a flush takes longer than a short run; after a crash of the machine, runs
                       // whose rows were not flushed are repeated
  double csv_s = 0;    // each write rewrites the whole CSV file
};

// One thread at a time.
class TableWriter {
 public:
  // `seconds` is a monotonic clock that starts at 0. `table` must outlive this object.
  TableWriter(ResultTable& table, WriteIntervals intervals, std::function<double()> seconds)
      : table_(table), intervals_(intervals), seconds_(std::move(seconds)) {}

  // Appends rows of runs that have no row yet.
  void write(std::span<const Row> rows);

 private:
  ResultTable& table_;
  const WriteIntervals intervals_;
  const std::function<double()> seconds_;
  double next_flush_s_ = 0;
  double next_csv_s_ = 0;
};

}  // namespace grove::detail::batch
