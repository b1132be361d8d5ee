// SPDX-License-Identifier: MIT
// The rows of many runs on disk, and what is still to be run.
//
//     DIR/results.jsonl   one line of JSON per run, appended when it has ended
//     DIR/results.csv     the same for spreadsheets, made from it
//
// Every pair of an instance and a method has at most one row, in a comparison of methods one for
// each seed. Whatever kills the program leaves whole rows and at most one torn line at the end,
// which the next run drops. The same command again goes on where it stopped: a pair is run again
// only when
//   - it has no row,
//   - its row is an error: whoever repeats the command has mended the cause, as a rule, and if not,
//     the error comes again,
//   - the plan that its row names is gone, or
//   - its instance has changed since, in a table of plans.
// What struck a limit is a result and stays. Another version of the program or another number of
// threads is no reason: each row tells its own. Nothing else is thrown away unasked: a row of
// another run is refused. Rows of pairs that the command does not name stay.
//
// What crashes the whole program (memory, as a rule) would do so again and keep all others waiting:
// runs that an earlier command began and did not end come last, those begun most often at the very
// end. DIR/.begun knows them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "batch/folder.h"
#include "batch/line_file.h"
#include "batch/row.h"

namespace grove::detail::batch {

enum class TableOf : std::uint8_t {
  kMethods,  // a comparison: methods differ in options, limits, seeds; if an instance has changed,
             // its rows are data that someone may still want
  kPlans,    // of one search: all rows have the same settings; the plan of an instance that has
             // changed is worth nothing
};

// Of one process, and of one thread at a time; a lock keeps other processes out where the file
// system has locks.
class ResultTable {
 public:
  // Opens the table in `folder`, which is made if missing. Throws InputError when it cannot be read
  // or written, or is in use by another run.
  ResultTable(std::filesystem::path folder, TableOf what);

  // Which of `runs` are to be done: their positions, in the order in which to do them. Once, before
  // all below: drops the rows of what is run again, and a torn line. Throws InputError when a row
  // is of another run.
  std::vector<std::size_t> begin(const std::vector<Run>& runs);

  // `run` begins; only for those whose crash takes the whole program with it.
  void note_begun(const Run& run);
  // Rows of pairs that have none. They outlive this process when this returns.
  void append(std::span<const Row> rows);
  // Returns when all rows would outlive a crash of the machine.
  void flush();
  // Makes DIR/results.csv anew, whole or not at all: the runs in their order, then what is left
  // from others.
  void write_csv() const;
  // The command ends in good order: what is not finished was not to blame.
  void end();

  // The rows that stand, in the order in which they ended.
  const std::vector<Row>& rows() const { return rows_; }
  // The row of a run; null: it has none. Valid until the next append().
  const Row* find(const Run& run) const;

 private:
  using Pair = std::tuple<std::string, std::string, std::int64_t>;  // instance, method, seed

  Pair pair_of(const Run& run) const {
    return {run.instance, run.settings.method, what_ == TableOf::kMethods ? run.settings.seed : 0};
  }
  void read();
  void require_same(const Row& row, const Run& run) const;
  bool stands(const Run& run) const;
  void keep_rows_but_of(const std::vector<Pair>& pairs);
  void put_last_what_was_begun(std::vector<std::size_t>& left, const std::vector<Run>& runs);
  void index_rows();
  std::filesystem::path file() const { return folder_ / "results.jsonl"; }
  std::filesystem::path begun_file() const { return folder_ / ".begun"; }

  const std::filesystem::path folder_;
  const TableOf what_;
  const FolderLock lock_;
  std::vector<Row> rows_;
  std::map<Pair, std::size_t> index_;  // of rows_
  std::map<Pair, std::size_t> order_;  // of the runs
  bool torn_ = false;
  std::optional<LineFile> lines_;
  std::optional<LineFile> begun_;
};

// The table for spreadsheets in `folder`.
std::filesystem::path csv_file(const std::filesystem::path& folder);
// Where the plan of an instance is, relative to the folder of the table.
std::string plan_file(const std::string& id);

}  // namespace grove::detail::batch
