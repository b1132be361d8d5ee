// SPDX-License-Identifier: MIT
// The result table of a batch on disk, and the runs that are still missing in it.
//
//     DIR/results.jsonl   one line of JSON per run, appended when the run has ended
//     DIR/results.csv     the same for spreadsheets, generated from results.jsonl
//
// A pair of an instance and a method has at most one row; in a comparison of methods, one row for
// each seed. If the program is killed, all rows are complete except for at most one incomplete line
// at the end, which the next run removes. If the same command is started again, it resumes. It runs
// a pair again only if
// - the pair has no row,
// - its row is an error: usually the user has fixed the cause before repeating the command, and if
//   not, the error occurs again,
// - the plan file of its row is missing, or
// - in a table of plans, its instance has changed since.
//
// A run that reached a limit is a result and is kept. A different version of the program or a
// different number of threads does not cause a repetition, because each row states its own. No
// other row is removed without a request: if a row belongs to a run with different settings, this
// is an error. Rows of pairs that the command does not name are kept.
//
// An instance that crashes the whole program (usually for lack of memory) would do so again and
// delay all others. Runs that an earlier command started but did not finish therefore come last, in
// ascending order of the number of times their instances were started. DIR/.begun lists these
// instances.
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

// A file to which whole lines are appended. If the process is killed, only the last line can be
// incomplete. One thread at a time.
class LineFile {
 public:
  // Creates the file if it is missing. Throws InputError if it cannot be written.
  explicit LineFile(std::filesystem::path path);

  // Appends `lines`, each of which ends with a newline. Throws InputError if that fails.
  void append(std::string_view lines);
  // Returns once everything appended would survive a system crash. Throws InputError if that fails.
  void flush();

 private:
  const std::filesystem::path path_;
  const FileDescriptor file_;
};

// The complete lines of `text`, the content of a LineFile, as views into `text`. An incomplete last
// line, and empty lines at the end, are omitted.
std::vector<std::string_view> whole_lines(std::string_view text);

enum class TableOf : std::uint8_t {
  kMethods,  // a comparison: methods differ in options, limits, seeds; rows of an instance that
             // has changed are kept, because their data may still be needed
  kPlans,    // plans of one method: all rows have the same settings; the plan of an instance that
             // has changed is useless
};

// The result table in a folder. A lock excludes other processes if the file system supports locks.
// One thread at a time.
class ResultTable {
 public:
  // Opens the table in `folder`, which is created if it is missing. Throws InputError if the table
  // cannot be read or written, or is in use by another process.
  ResultTable(std::filesystem::path folder, TableOf what);

  // Returns the runs to do as positions in `runs`, in the order in which to do them. Removes the
  // rows of runs to be repeated, and an incomplete line. Call it once, before all functions below.
  // Throws InputError if a row belongs to a run with different settings.
  std::vector<std::size_t> begin(const std::vector<Run>& runs);

  // Records that `run` starts. Call it only for runs whose crash would end the whole program.
  void mark_started(const Run& run);
  // Appends rows of pairs that have no row yet. Once it returns, they survive the end of this
  // process.
  void append(std::span<const Row> rows);
  // Once it returns, all rows survive a system crash.
  void flush();
  // Replaces DIR/results.csv atomically: first the rows of the runs passed to begin(), in their
  // order, then all other rows.
  void write_csv() const;
  // Call it when the command ends normally. Removes DIR/.begun, because the unfinished runs did not
  // crash.
  void end();

  // All rows, in the order in which the runs ended.
  const std::vector<Row>& rows() const { return rows_; }
  // The row of a run. Returns nullptr if there is none. The pointer is valid until the next call of
  // append().
  const Row* find(const Run& run) const;

 private:
  using Pair = std::tuple<std::string, std::string, std::int64_t>;  // instance, method, seed

  Pair pair_of(const Run& run) const {
    return {run.instance, run.settings.method, kind_ == TableOf::kMethods ? run.settings.seed : 0};
  }
  void read();
  void require_same(const Row& row, const Run& run) const;
  bool is_valid_result(const Run& run) const;
  void erase_rows_of(const std::vector<Pair>& pairs);
  void defer_started_runs(std::vector<std::size_t>& left, const std::vector<Run>& runs);
  void index_rows();
  std::filesystem::path file() const { return folder_ / "results.jsonl"; }
  std::filesystem::path begun_file() const { return folder_ / ".begun"; }

  const std::filesystem::path folder_;
  const TableOf kind_;
  const FolderLock lock_;
  std::vector<Row> rows_;
  std::map<Pair, std::size_t> index_;  // positions in rows_
  std::map<Pair, std::size_t> order_;  // positions in `runs` of begin()
  bool has_incomplete_line_ = false;
  std::optional<LineFile> lines_;
  std::optional<LineFile> begun_;
};

// The path of the table for spreadsheets in `folder`.
std::filesystem::path csv_file(const std::filesystem::path& folder);
// The path of an instance's plan, relative to the folder of the table.
std::string plan_file(const std::string& id);

}  // namespace grove::detail::batch
