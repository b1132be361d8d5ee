// SPDX-License-Identifier: MIT
#include "mpi/batch/result_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "grove/io/atomic_file.h"
#include "grove/io/input_error.h"
#include "grove/io/plan_file.h"
#include "grove/io/text_file.h"

namespace grove::batch {
namespace {

namespace fs = std::filesystem;

fs::path made(fs::path folder) {
  make_folder(folder);
  return folder;
}

std::string value_text(const Settings& settings, const std::string& name) {
  const auto it = settings.find(name);
  return it == settings.end() ? "not given" : it->second;
}

// "omega 0.01 there, 0 here; seed 1 there, 2 here"
std::string differences(const Settings& theirs, const Settings& ours) {
  std::set<std::string> names;
  for (const auto& [name, value] : theirs) names.insert(name);
  for (const auto& [name, value] : ours) names.insert(name);
  std::vector<std::string> texts;
  for (const std::string& name : names)
    if (value_text(theirs, name) != value_text(ours, name))
      texts.push_back(fmt::format("{} {} there, {} here", name, value_text(theirs, name),
                                  value_text(ours, name)));
  return fmt::format("{}", fmt::join(texts, "; "));
}

}  // namespace

ResultTable::ResultTable(fs::path folder, Settings settings)
    : folder_(made(std::move(folder))), settings_(std::move(settings)), lock_(folder_) {
  read();
}

void ResultTable::read() {
  if (!fs::exists(file())) return;
  const std::string text = read_text(file());
  torn_ = !text.empty() && text.back() != '\n';
  int number = 0;
  for (const std::string_view line : whole_lines(text)) {
    ++number;
    if (line.empty()) continue;  // people edit
    try {
      RowAndSettings read = parse_json_line(line);
      require_same_settings(read.settings, number);
      rows_.push_back(std::move(read.row));
    } catch (const std::invalid_argument& error) {
      throw InputError(file().string(), fmt::format("line {}", number),
                       fmt::format("expected a row of results, or the line deleted to solve its "
                                   "instance again ({})",
                                   error.what()));
    }
  }
  index_rows();
}

void ResultTable::require_same_settings(const Settings& theirs, int line) const {
  if (theirs == settings_) return;
  throw InputError(
      file().string(), fmt::format("line {}", line),
      fmt::format("was made with other options; expected the same, or another --output, or this "
                  "one deleted ({})",
                  differences(theirs, settings_)));
}

void ResultTable::index_rows() {
  index_.clear();
  for (std::size_t i = 0; i < rows_.size(); ++i) index_[rows_[i].id] = i;
}

const Row* ResultTable::find(const std::string& id) const {
  const auto it = index_.find(id);
  return it == index_.end() ? nullptr : &rows_[it->second];
}

bool ResultTable::stands(const Row& row, const Entry& entry) const {
  std::error_code error;
  const bool has_plan =
      row.result.plan_file.empty() || fs::exists(folder_ / row.result.plan_file, error);
  return !row.failed() && has_plan && row.digest == entry.digest;
}

std::vector<Entry> ResultTable::begin(const std::vector<Entry>& entries) {
  std::vector<Entry> left;
  for (const Entry& entry : entries) {
    order_.emplace(entry.id, order_.size());
    const Row* row = find(entry.id);
    if (row == nullptr || !stands(*row, entry)) left.push_back(entry);
    make_folder((folder_ / plan_file(entry)).parent_path());
  }
  keep_rows_but_of(left);
  put_last_what_was_begun(left);
  return left;
}

// Of two rows of an instance, which only people can make, the later stands.
void ResultTable::keep_rows_but_of(const std::vector<Entry>& entries) {
  for (const Entry& entry : entries) index_.erase(entry.id);
  std::vector<Row> kept;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto it = index_.find(rows_[i].id);
    if (it != index_.end() && it->second == i) kept.push_back(std::move(rows_[i]));
  }
  const bool as_in_file = !torn_ && kept.size() == rows_.size() && fs::exists(file());
  rows_ = std::move(kept);
  index_rows();
  if (!as_in_file) {
    std::string text;
    for (const Row& row : rows_) text += json_line(row, settings_) + "\n";
    write_file_atomically(file(), text);
  }
  lines_.emplace(file());
}

void ResultTable::put_last_what_was_begun(std::vector<Entry>& entries) {
  std::map<std::string, int, std::less<>> times;
  for (const Entry& entry : entries) times[entry.id] = 0;
  std::string kept;
  const std::string text = fs::exists(begun_file()) ? read_text(begun_file()) : "";
  for (const std::string_view id : whole_lines(text))
    if (const auto it = times.find(id); it != times.end()) {
      ++it->second;
      kept += it->first + "\n";
    }
  std::ranges::stable_sort(entries, {}, [&](const Entry& entry) { return times[entry.id]; });
  if (kept != text) write_file_atomically(begun_file(), kept);
  begun_.emplace(begun_file());
}

// Not flushed: a crash of the whole machine is not the instance's fault.
void ResultTable::note_begun(const Entry& entry) {
  begun_->append(entry.id + "\n");
}

void ResultTable::append(std::span<const Row> rows) {
  std::string text;
  for (const Row& row : rows) {
    if (!index_.emplace(row.id, rows_.size()).second)
      throw std::logic_error("a second row of " + row.id);
    rows_.push_back(row);
    text += json_line(row, settings_) + "\n";
  }
  lines_->append(text);
  lines_->flush();
}

void ResultTable::write_csv() const {
  std::vector<const Row*> rows;
  for (const Row& row : rows_) rows.push_back(&row);
  std::ranges::stable_sort(rows, {}, [&](const Row* row) {
    const auto it = order_.find(row->id);
    return it == order_.end() ? order_.size() : it->second;
  });
  std::string text = csv_header(settings_);
  for (const Row* row : rows) text += csv_line(*row, settings_);
  write_file_atomically(folder_ / "results.csv", text);
}

void ResultTable::end() {
  begun_.reset();
  std::error_code ignored;
  fs::remove(begun_file(), ignored);
}

std::string plan_file(const Entry& entry) {
  return fmt::format("plans/{}.plan.json", entry.id);
}

std::string write_plan(const fs::path& folder, const Entry& entry, const Instance& instance,
                       const Solution& solution) {
  std::string file = plan_file(entry);
  write_solution(folder / file, instance, solution);
  return file;
}

}  // namespace grove::batch
