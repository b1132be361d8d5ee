// SPDX-License-Identifier: MIT
// The results of a batch on disk, and what is still to be solved.
//
//     DIR/results.jsonl        one line of JSON per instance, appended when it is finished
//     DIR/results.csv          the same for spreadsheets, made from it
//     DIR/plans/ID.plan.json   one plan file per instance
//
// Every instance has at most one row. A run that is killed leaves whole rows and at most one torn
// line at the end, which the next run drops. The same command again goes on where it stopped: an
// instance is solved again only when
//   - it has no row,
//   - its row is an error: whoever repeats the command has mended the cause, as a rule, and if not,
//     the error comes again,
//   - its plan file is missing, or
//   - the instance or its map have changed since.
// What struck a limit is a result and stays. Other options would make results that do not belong
// into one table: they are refused. Another version of the program is not, nor are other numbers of
// ranks and threads: each row tells its own. Rows of instances that the batch does not name stay.
//
// What crashes the whole job (memory, as a rule) would do so again and keep all others waiting:
// instances that an earlier run began and did not end come last, those begun most often at the very
// end. DIR/.begun knows them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "grove/batch/entry.h"
#include "grove/batch/folder.h"
#include "grove/batch/line_file.h"
#include "grove/model/instance.h"
#include "grove/model/plan.h"
#include "mpi/batch/row.h"

namespace grove::batch {

// Of one process and one thread; a lock keeps other processes out where the file system has locks.
class ResultTable {
 public:
  // Opens the table in `folder`, which is made if missing. Throws InputError when it cannot be read
  // or written, holds rows of other `settings`, or is in use by another run.
  ResultTable(std::filesystem::path folder, Settings settings);
  ResultTable(const ResultTable&) = delete;
  ResultTable& operator=(const ResultTable&) = delete;

  // What of `entries` is to be solved, in the order in which to do it. Once, before all below:
  // drops the rows of what is solved again, mends the file and makes the folders of the plans.
  std::vector<Entry> begin(const std::vector<Entry>& entries);

  // `entry` is about to be solved.
  void note_begun(const Entry& entry);
  // Rows of instances that have none yet. They are on disk when this returns.
  void append(std::span<const Row> rows);
  // Makes DIR/results.csv anew, whole or not at all: the batch in its order, then what is left from
  // others.
  void write_csv() const;
  // The run ends in good order: what is not finished was not to blame.
  void end();

  // The rows that stand, in the order in which they were finished.
  const std::vector<Row>& rows() const { return rows_; }
  // The row of an instance; null: it has none. Valid until the next append().
  const Row* find(const std::string& id) const;

 private:
  void read();
  void require_same_settings(const Settings& theirs, int line) const;
  bool stands(const Row& row, const Entry& entry) const;
  void keep_rows_but_of(const std::vector<Entry>& entries);
  void put_last_what_was_begun(std::vector<Entry>& entries);
  void index_rows();
  std::filesystem::path file() const { return folder_ / "results.jsonl"; }
  std::filesystem::path begun_file() const { return folder_ / ".begun"; }

  const std::filesystem::path folder_;
  const Settings settings_;
  const FolderLock lock_;
  std::vector<Row> rows_;
  std::map<std::string, std::size_t> index_;  // of rows_, by id
  std::map<std::string, std::size_t> order_;  // of the batch, by id
  bool torn_ = false;
  std::optional<LineFile> lines_;
  std::optional<LineFile> begun_;
};

// Where the plan of `entry` is, relative to the folder of the table.
std::string plan_file(const Entry& entry);

// Writes the plan of `entry` to its place below `folder`, whole or not at all, and returns
// plan_file(entry). Throws InputError when it cannot.
std::string write_plan(const std::filesystem::path& folder, const Entry& entry,
                       const Instance& instance, const Solution& solution);

}  // namespace grove::batch
