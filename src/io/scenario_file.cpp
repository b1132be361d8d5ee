// SPDX-License-Identifier: MIT
#include "io/scenario_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/text_file.h"
#include "model/parse_number.h"

namespace grove::detail {
namespace {

constexpr std::string_view kBlanks = " \t";
constexpr std::size_t kFields = 9;
constexpr const char* kFieldNames =
    "bucket, map, width, height, start x, start y, goal x, goal y, length";

struct Field {
  std::string_view text;
  std::size_t column;  // from 1
};

std::vector<Field> split_fields(std::string_view line) {
  std::vector<Field> fields;
  std::size_t begin = line.find_first_not_of(kBlanks);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    fields.push_back({line.substr(begin, end - begin), begin + 1});
    begin = line.find_first_not_of(kBlanks, end);
  }
  return fields;
}

// Reads one line of the file, and reports errors with their positions.
class RowReader {
 public:
  RowReader(const std::string& file, std::size_t line, std::string_view text)
      : file_(file), line_(line), fields_(split_fields(text)) {
    if (fields_.size() != kFields)
      fail(end_column(text), fmt::format("the row has {} fields; expected {}: {}", fields_.size(),
                                         kFields, kFieldNames));
  }

  ScenarioRow read() const {
    integer(0, 0);  // the bucket
    length(8);
    return {.line = static_cast<int>(line_),
            .map = std::string(fields_[1].text),
            .width = integer(2, 1),
            .height = integer(3, 1),
            .start = {integer(4, 0), integer(5, 0)},
            .goal = {integer(6, 0), integer(7, 0)}};
  }

 private:
  [[noreturn]] void fail(std::size_t column, std::string_view message) const {
    throw InputError(file_, line_and_column(line_, column), message);
  }

  // The column of the first surplus field or, if a field is missing, of the end of the line.
  std::size_t end_column(std::string_view text) const {
    return fields_.size() > kFields ? fields_[kFields].column : text.size() + 1;
  }

  int integer(std::size_t field, int least) const {
    const auto [text, column] = fields_[field];
    const auto value = parse_number(text, least);
    if (!value)
      fail(column, fmt::format("found '{}'; expected an integer from {} to {}", one_line(text),
                               least, std::numeric_limits<int>::max()));
    return *value;
  }

  void length(std::size_t field) const {
    const auto [text, column] = fields_[field];
    if (!parse_number(text, 0.0))
      fail(column, fmt::format("found '{}'; expected a length of at least 0", one_line(text)));
  }

  const std::string& file_;
  std::size_t line_;
  std::vector<Field> fields_;
};

void require_version(const std::string& file, const std::vector<std::string_view>& lines) {
  const std::vector<Field> fields = split_fields(lines.empty() ? "" : lines.front());
  const bool known = fields.size() == 2 && fields[0].text == "version" &&
                     (fields[1].text == "1" || fields[1].text == "1.0");
  if (!known)
    throw InputError(file, line_and_column(1, 1), "expected 'version 1' as the first line");
}

}  // namespace

std::vector<ScenarioRow> read_scenario(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string text = read_text(path);
  const std::vector<std::string_view> lines = split_lines(text);
  require_version(file, lines);
  std::vector<ScenarioRow> rows;
  for (std::size_t k = 1; k < lines.size(); ++k)
    rows.push_back(RowReader(file, k + 1, lines[k]).read());
  return rows;
}

std::filesystem::path map_beside(const std::filesystem::path& scenario, const InputRules& rules) {
  const std::vector<ScenarioRow> rows = read_scenario(scenario);
  if (rows.empty()) return {};
  try {
    const std::filesystem::path map = file_in_folder(
        rules, scenario.parent_path(), std::filesystem::path(rows.front().map).filename());
    return std::filesystem::is_regular_file(map) ? map : std::filesystem::path();
  } catch (const std::invalid_argument& error) {
    throw InputError(scenario.string(), fmt::format("line {}", rows.front().line), error.what());
  }
}

void require_same_map(const std::filesystem::path& scenario, std::span<const ScenarioRow> rows,
                      const std::filesystem::path& map, const Grid& grid) {
  const auto fail = [&](const ScenarioRow& row, const std::string& message) {
    throw InputError(scenario.string(), fmt::format("line {}", row.line), message);
  };
  const std::string name = map.filename().string();
  for (const ScenarioRow& row : rows) {
    if (std::filesystem::path(row.map).filename() != name)
      fail(row, fmt::format("the row is for map '{}'; expected '{}'", one_line(row.map), name));
    if (row.width != grid.width() || row.height != grid.height())
      fail(row, fmt::format("the row is for a map of {} x {} cells; expected {} x {}", row.width,
                            row.height, grid.width(), grid.height()));
  }
}

void write_scenario(const std::filesystem::path& path, const std::vector<ScenarioRow>& rows,
                    const std::vector<Time>& lengths) {
  std::string text = "version 1\n";
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const ScenarioRow& row = rows[k];
    text +=
        fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", lengths.at(k) / 4, row.map, row.width,
                    row.height, row.start.x, row.start.y, row.goal.x, row.goal.y, lengths.at(k));
  }
  write_file_atomically(path, text);
}

}  // namespace grove::detail
