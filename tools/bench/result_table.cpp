// SPDX-License-Identifier: MIT
#include "tools/bench/result_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "grove/io/atomic_file.h"
#include "grove/io/input_error.h"
#include "grove/io/text_file.h"

namespace grove::bench {
namespace {

namespace fs = std::filesystem;

fs::path made(fs::path folder) {
  batch::make_folder(folder);
  return folder;
}

std::string limit_text(std::optional<double> gigabytes) {
  return gigabytes ? fmt::format("{} GB", *gigabytes) : "by the machine";
}

// "seed 1 there, 2 here; time limit 60 there, 180 here"
std::string differences(const RunIdentity& there, const RunIdentity& here) {
  std::vector<std::string> texts;
  const auto compare = [&](const char* what, const auto& a, const auto& b) {
    if (a != b) texts.push_back(fmt::format("{} '{}' there, '{}' here", what, a, b));
  };
  compare("options", there.options, here.options);
  compare("seed", there.seed, here.seed);
  compare("time limit", there.time_limit_s, here.time_limit_s);
  compare("memory limit", limit_text(there.memory_limit_gb), limit_text(here.memory_limit_gb));
  if (there.digest != here.digest) texts.push_back("the instance or its map has changed since");
  return fmt::format("{}", fmt::join(texts, "; "));
}

}  // namespace

ResultTable::ResultTable(fs::path folder) : folder_(made(std::move(folder))), lock_(folder_) {
  read();
}

void ResultTable::read() {
  if (!fs::exists(file())) return;
  const std::string text = read_text(file());
  torn_ = !text.empty() && text.back() != '\n';
  int number = 0;
  for (const std::string_view line : batch::whole_lines(text)) {
    ++number;
    if (line.empty()) continue;  // people edit
    try {
      rows_.push_back(parse_json_line(line));
    } catch (const std::invalid_argument& error) {
      throw InputError(file().string(), fmt::format("line {}", number),
                       fmt::format("expected a row of results, or the line deleted to run it again "
                                   "({})",
                                   error.what()));
    }
  }
  index_rows();
}

void ResultTable::index_rows() {
  index_.clear();
  for (std::size_t i = 0; i < rows_.size(); ++i)
    index_[{rows_[i].run.instance, rows_[i].run.method}] = i;
}

const Row* ResultTable::find(const RunIdentity& run) const {
  const auto it = index_.find({run.instance, run.method});
  return it == index_.end() ? nullptr : &rows_[it->second];
}

bool ResultTable::stands(const RunIdentity& run) const {
  const Row* row = find(run);
  if (row == nullptr || row->outcome.failed()) return false;
  if (row->run != run)
    throw InputError(file().string(), "",
                     fmt::format("holds a row of another run of {} on {} ({}); expected the same, "
                                 "another name, another --output-dir, or that row deleted",
                                 run.method, run.instance, differences(row->run, run)));
  return true;
}

std::vector<std::size_t> ResultTable::begin(const std::vector<RunIdentity>& runs) {
  std::vector<std::size_t> left;
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    order_.emplace(Pair(runs[i].instance, runs[i].method), i);
    if (stands(runs[i])) continue;
    left.push_back(i);
    pairs.emplace_back(runs[i].instance, runs[i].method);
  }
  keep_rows_but_of(pairs);
  return left;
}

// Of two rows of a pair, which only people can make, the later stands.
void ResultTable::keep_rows_but_of(const std::vector<Pair>& pairs) {
  for (const Pair& pair : pairs) index_.erase(pair);
  std::vector<Row> kept;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto it = index_.find({rows_[i].run.instance, rows_[i].run.method});
    if (it != index_.end() && it->second == i) kept.push_back(std::move(rows_[i]));
  }
  const bool as_in_file = !torn_ && kept.size() == rows_.size() && fs::exists(file());
  rows_ = std::move(kept);
  index_rows();
  if (!as_in_file) {
    std::string text;
    for (const Row& row : rows_) text += json_line(row) + "\n";
    write_file_atomically(file(), text);
  }
  lines_.emplace(file());
}

void ResultTable::append(const Row& row) {
  if (!index_.emplace(Pair(row.run.instance, row.run.method), rows_.size()).second)
    throw std::logic_error("a second row of " + row.run.method + " on " + row.run.instance);
  rows_.push_back(row);
  lines_->append(json_line(row) + "\n");
}

void ResultTable::flush() {
  lines_->flush();
}

void ResultTable::write_csv() const {
  std::vector<const Row*> rows;
  for (const Row& row : rows_) rows.push_back(&row);
  std::ranges::stable_sort(rows, {}, [&](const Row* row) {
    const auto it = order_.find({row->run.instance, row->run.method});
    return it == order_.end() ? order_.size() : it->second;
  });
  std::string text = csv_header();
  for (const Row* row : rows) text += csv_line(*row);
  write_file_atomically(folder_ / "results.csv", text, Outlives::kProcess);
}

}  // namespace grove::bench
