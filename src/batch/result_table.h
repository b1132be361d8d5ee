// SPDX-License-Identifier: MIT
// The table of results of a batch on disk, and the runs that are still missing.
//
//     DIR/results.jsonl   one line of JSON per run, appended when the run has ended
//     DIR/results.csv     the same for spreadsheets, generated from results.jsonl
//
// Each pair of an instance and a method has at most one row; in a comparison of methods, one row
// for each seed. If the program is killed, all rows are complete except for at most one incomplete
// line at the end, which the next run removes. If the same command is started again, it resumes. A
// pair is run again only if
// - it has no row,
// - its row is an error: usually the user has fixed the cause before repeating the command, and if
//   not, the error occurs again,
// - the plan file of its row is missing, or
// - its instance has changed since, in a table of plans.
//
// A run that reached a limit is a result and is kept. A different version of the program or number
// of threads does not cause a repetition, because each row states its own. No other row is removed
// without a request: a row of a different run is an error. Rows of pairs that the command does not
// name are kept.
//
// An instance that crashes the whole program (usually for lack of memory) would do so again and
// delay all others. So runs that an earlier command began and did not end come last, the ones begun
// most often at the very end. DIR/.begun lists them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "batch/folder.h"
#include "batch/row.h"
#include "io/file_descriptor.h"

namespace grove::detail::batch {

// A file to which whole lines are appended. If the process is killed, at most the last line is
// incomplete. One thread at a time.
class LineFile {
 public:
  // Creates the file if it is missing. Throws InputError if it cannot be written.
  explicit LineFile(std::filesystem::path path);

  // Appends `lines`, which end in line ends, in one write. Throws InputError if that fails.
  void append(std::string_view lines);
  // Returns when everything appended would survive a system crash. Throws InputError.
  void flush();

 private:
  const std::filesystem::path path_;
  const FileDescriptor file_;
};

// The complete lines of `text`, the content of such a file, as views into `text`. An incomplete
// last line is omitted.
std::vector<std::string_view> whole_lines(std::string_view text);

enum class TableOf : std::uint8_t {
  kMethods,  // a comparison: methods differ in options, limits, seeds; the rows of an instance
             // that has changed are kept, because they are data that may still be needed
  kPlans,    // of one search: all rows have the same settings; the plan of an instance that has
             // changed is useless
};

// One process and one thread at a time. A lock excludes other processes if the file system supports
// locks.
class ResultTable {
 public:
  // Opens the table in `folder`, which is created if it is missing. Throws InputError if the table
  // cannot be read or written, or is in use by another run.
  ResultTable(std::filesystem::path folder, TableOf what);

  // Returns the runs to do, as positions in `runs`, in the order in which to do them. Removes the
  // rows of the runs to be repeated, and an incomplete line. Call it once, before all functions
  // below. Throws InputError if a row belongs to a different run.
  std::vector<std::size_t> begin(const std::vector<Run>& runs);

  // Records that `run` begins. Call it only for runs whose crash ends the whole program.
  void mark_started(const Run& run);
  // Appends rows of pairs that have none. When it returns, they survive the end of this process.
  void append(std::span<const Row> rows);
  // When it returns, all rows survive a system crash.
  void flush();
  // Replaces DIR/results.csv atomically: first the rows of `runs` of begin() in their order, then
  // the other rows.
  void write_csv() const;
  // Call it when the command ends normally. Removes DIR/.begun, because unfinished runs did not
  // crash.
  void end();

  // All rows, in the order in which the runs ended.
  const std::vector<Row>& rows() const { return rows_; }
  // The row of a run; nullptr if there is none. Valid until the next append().
  const Row* find(const Run& run) const;

 private:
  using Pair = std::tuple<std::string, std::string, std::int64_t>;  // instance, method, seed

  Pair pair_of(const Run& run) const {
    return {run.instance, run.settings.method, what_ == TableOf::kMethods ? run.settings.seed : 0};
  }
  void read();
  void require_same(const Row& row, const Run& run) const;
  bool stands(const Run& run) const;
  void erase_rows_of(const std::vector<Pair>& pairs);
  void defer_started_runs(std::vector<std::size_t>& left, const std::vector<Run>& runs);
  void index_rows();
  std::filesystem::path file() const { return folder_ / "results.jsonl"; }
  std::filesystem::path begun_file() const { return folder_ / ".begun"; }

  const std::filesystem::path folder_;
  const TableOf what_;
  const FolderLock lock_;
  std::vector<Row> rows_;
  std::map<Pair, std::size_t> index_;  // positions in rows_
  std::map<Pair, std::size_t> order_;  // positions in `runs` of begin()
  bool has_incomplete_line_ = false;
  std::optional<LineFile> lines_;
  std::optional<LineFile> begun_;
};

// The table for spreadsheets in `folder`.
std::filesystem::path csv_file(const std::filesystem::path& folder);
// The path of an instance's plan, relative to the folder of the table.
std::string plan_file(const std::string& id);

}  // namespace grove::detail::batch
