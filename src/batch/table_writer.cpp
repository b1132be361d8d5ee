// SPDX-License-Identifier: MIT
#include "batch/table_writer.h"

namespace grove::detail::batch {

void TableWriter::write(std::span<const Row> rows) {
  table_.append(rows);
  if (seconds_() >= next_flush_s_) {
    table_.flush();
    next_flush_s_ = seconds_() + intervals_.flush_s;
  }
  if (seconds_() < next_csv_s_) return;
  table_.write_csv();
  next_csv_s_ = seconds_() + intervals_.csv_s;
}

}  // namespace grove::detail::batch
