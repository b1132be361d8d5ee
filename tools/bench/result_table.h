// SPDX-License-Identifier: MIT
// The rows of a bench on disk, and what is still to be run.
//
//     DIR/results.jsonl   one line of JSON per run, appended when it has ended
//     DIR/results.csv     the same for spreadsheets, made from it
//
// Every pair of an instance and a method has at most one row. A bench that is killed leaves whole
// rows and at most one torn line at the end, which the next one drops. The same command again goes
// on where it stopped: a pair is run again only when it has no row, or when its row is an error
// (whoever repeats the command has mended the cause, as a rule, and if not, the error comes again).
// A row of another run - the instance has changed, or other options, limits or another seed go by
// the method's name - is no result of this one, and nothing is thrown away unasked: it is refused.
// Rows of pairs that the command does not name stay.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "grove/batch/folder.h"
#include "grove/batch/line_file.h"
#include "tools/bench/row.h"

namespace grove::bench {

// Of one process, and of one thread at a time.
class ResultTable {
 public:
  // Opens the table in `folder`, which is made if missing. Throws InputError when it cannot be read
  // or written, or is in use by another bench.
  explicit ResultTable(std::filesystem::path folder);

  // Which of `runs` are to be done: their positions, in order. Once, before all below: drops the
  // rows of what is run again, and a torn line. Throws InputError when a row is of another run.
  std::vector<std::size_t> begin(const std::vector<RunIdentity>& runs);

  // A row of a pair that has none. It outlives this process when this returns.
  void append(const Row& row);
  // Returns when all rows would outlive a crash of the machine.
  void flush();
  // Makes DIR/results.csv anew, whole or not at all: the runs in their order, then what is left
  // from others.
  void write_csv() const;

  // The rows that stand, in the order in which they ended.
  const std::vector<Row>& rows() const { return rows_; }
  // The row of a run; null: it has none. Valid until the next append().
  const Row* find(const RunIdentity& run) const;

 private:
  using Pair = std::pair<std::string, std::string>;  // instance, method

  void read();
  bool stands(const RunIdentity& run) const;
  void keep_rows_but_of(const std::vector<Pair>& pairs);
  void index_rows();
  std::filesystem::path file() const { return folder_ / "results.jsonl"; }

  const std::filesystem::path folder_;
  const batch::FolderLock lock_;
  std::vector<Row> rows_;
  std::map<Pair, std::size_t> index_;  // of rows_
  std::map<Pair, std::size_t> order_;  // of the runs
  bool torn_ = false;
  std::optional<batch::LineFile> lines_;
};

}  // namespace grove::bench
