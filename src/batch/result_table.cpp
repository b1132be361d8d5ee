// SPDX-License-Identifier: MIT
#include "batch/result_table.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/text_file.h"
#include "model/assert.h"

namespace grove::detail::batch {

std::vector<std::string_view> whole_lines(std::string_view text) {
  return split_lines(text.substr(0, text.rfind('\n') + 1));
}

LineFile::LineFile(std::filesystem::path path)
    : path_(std::move(path)), file_(path_, O_WRONLY | O_APPEND | O_CREAT) {
  if (!file_.is_open()) fail_to_write(path_);
}

void LineFile::append(std::string_view lines) {
  if (!write_all(file_.get(), lines)) fail_to_write(path_);
}

void LineFile::flush() {
  if (::fsync(file_.get()) != 0) fail_to_write(path_);
}

namespace {

namespace fs = std::filesystem;

fs::path created(fs::path folder) {
  make_folder(folder);
  return folder;
}

std::string limit_text(std::optional<double> gigabytes) {
  return gigabytes ? fmt::format("{} GB", *gigabytes) : "by the machine";
}

// Describes the relevant differences, such as "seed '1' there, '2' here; time limit '60' there,
// '180' here"; empty if there is none.
std::string differences(const Run& there, const Run& here, TableOf table) {
  std::vector<std::string> texts;
  const auto compare = [&](const char* what, const auto& a, const auto& b) {
    if (a != b) texts.push_back(fmt::format("{} '{}' there, '{}' here", what, a, b));
  };
  const Settings& a = there.settings;
  const Settings& b = here.settings;
  compare("method", a.method, b.method);
  compare("options", a.options, b.options);
  compare("omega", a.omega, b.omega);
  compare("seed", a.seed, b.seed);
  compare("time limit", a.time_limit_s, b.time_limit_s);
  compare("memory limit", limit_text(a.memory_limit_gb), limit_text(b.memory_limit_gb));
  if (table == TableOf::kMethods && there.digest != here.digest)
    texts.push_back("the instance or its map has changed");
  return fmt::format("{}", fmt::join(texts, "; "));
}

}  // namespace

ResultTable::ResultTable(fs::path folder, TableOf what)
    : folder_(created(std::move(folder))), kind_(what), lock_(folder_) {
  read();
}

void ResultTable::read() {
  if (!fs::exists(file())) return;
  const std::string text = read_text(file());
  has_incomplete_line_ = !text.empty() && text.back() != '\n';
  int number = 0;
  for (const std::string_view line : whole_lines(text)) {
    ++number;
    if (line.empty()) continue;  // a user may have edited the file
    try {
      rows_.push_back(parse_json_line(line));
    } catch (const std::invalid_argument& error) {
      throw InputError(file().string(), fmt::format("line {}", number),
                       fmt::format("expected a row of this version; use another folder, or delete "
                                   "the line to repeat the run ({})",
                                   error.what()));
    }
  }
  index_rows();
}

void ResultTable::index_rows() {
  index_.clear();
  for (std::size_t i = 0; i < rows_.size(); ++i) index_[pair_of(rows_[i].run)] = i;
}

const Row* ResultTable::find(const Run& run) const {
  const auto it = index_.find(pair_of(run));
  return it == index_.end() ? nullptr : &rows_[it->second];
}

void ResultTable::require_same(const Row& row, const Run& run) const {
  const std::string found = differences(row.run, run, kind_);
  if (found.empty()) return;
  throw InputError(file().string(), "",
                   fmt::format("has a row of another run of {} on {} ({}); expected the same run; "
                               "use another folder, or delete the row",
                               row.run.settings.method, row.run.instance, found));
}

bool ResultTable::is_valid_result(const Run& run) const {
  const Row* row = find(run);
  if (row == nullptr || row->outcome.failed()) return false;
  require_same(*row, run);
  std::error_code error;
  const bool has_plan = row->plan_file.empty() || fs::exists(folder_ / row->plan_file, error);
  return has_plan && row->run.digest == run.digest;
}

std::vector<std::size_t> ResultTable::begin(const std::vector<Run>& runs) {
  GROVE_CHECK(!lines_, "begin() is called once");
  std::vector<std::size_t> left;
  std::vector<Pair> pairs;
  if (kind_ == TableOf::kPlans && !runs.empty())
    for (const Row& row : rows_) require_same(row, runs.front());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    order_.emplace(pair_of(runs[i]), i);
    if (is_valid_result(runs[i])) continue;
    left.push_back(i);
    pairs.push_back(pair_of(runs[i]));
  }
  erase_rows_of(pairs);
  GROVE_CHECK(std::ranges::none_of(left, [&](std::size_t run) { return find(runs[run]); }),
              "no run to do has a row");
  defer_started_runs(left, runs);
  return left;
}

// If a pair has two rows, which only manual editing can cause, keeps the later one.
void ResultTable::erase_rows_of(const std::vector<Pair>& pairs) {
  for (const Pair& pair : pairs) index_.erase(pair);
  std::vector<Row> kept;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto it = index_.find(pair_of(rows_[i].run));
    if (it != index_.end() && it->second == i) kept.push_back(std::move(rows_[i]));
  }
  const bool as_in_file =
      !has_incomplete_line_ && kept.size() == rows_.size() && fs::exists(file());
  rows_ = std::move(kept);
  index_rows();
  GROVE_CHECK(index_.size() == rows_.size(), "a pair has at most one row");
  if (!as_in_file) {
    std::string text;
    for (const Row& row : rows_) text += json_line(row) + "\n";
    write_file_atomically(file(), text);
  }
  lines_.emplace(file());
}

void ResultTable::defer_started_runs(std::vector<std::size_t>& left, const std::vector<Run>& runs) {
  if (!fs::exists(begun_file())) return;
  std::map<std::string, int, std::less<>> times;
  for (const std::size_t i : left) times[runs[i].instance] = 0;
  std::string kept;
  const std::string text = read_text(begun_file());
  for (const std::string_view id : whole_lines(text))
    if (const auto it = times.find(id); it != times.end()) {
      ++it->second;
      kept += it->first + "\n";
    }
  std::ranges::stable_sort(left, {}, [&](std::size_t i) { return times[runs[i].instance]; });
  if (kept != text) write_file_atomically(begun_file(), kept);
}

// Does not flush, because an instance does not cause a system crash.
void ResultTable::mark_started(const Run& run) {
  if (!begun_) begun_.emplace(begun_file());
  begun_->append(run.instance + "\n");
}

void ResultTable::append(std::span<const Row> rows) {
  GROVE_CHECK(lines_, "rows are appended after begin()");
  std::string text;
  for (const Row& row : rows) {
    if (!index_.emplace(pair_of(row.run), rows_.size()).second)
      throw std::logic_error("a second row of " + row.run.settings.method + " on " +
                             row.run.instance);
    rows_.push_back(row);
    text += json_line(row) + "\n";
  }
  GROVE_CHECK(index_.size() == rows_.size(), "each row has its place in the index");
  lines_->append(text);
}

void ResultTable::flush() {
  lines_->flush();
}

void ResultTable::write_csv() const {
  std::vector<const Row*> rows;
  for (const Row& row : rows_) rows.push_back(&row);
  std::ranges::stable_sort(rows, {}, [&](const Row* row) {
    const auto it = order_.find(pair_of(row->run));
    return it == order_.end() ? order_.size() : it->second;
  });
  std::string text = csv_header();
  for (const Row* row : rows) text += csv_line(*row);
  write_file_atomically(csv_file(folder_), text, Durability::kProcess);
}

void ResultTable::end() {
  begun_.reset();
  std::error_code ignored;
  fs::remove(begun_file(), ignored);
}

fs::path csv_file(const fs::path& folder) {
  return folder / "results.csv";
}

std::string plan_file(const std::string& id) {
  return fmt::format("plans/{}.plan.json", id);
}

}  // namespace grove::detail::batch
