// SPDX-License-Identifier: MIT
#include "io/map_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/text_file.h"
#include "model/parse_number.h"

namespace grove::detail {
namespace {

constexpr std::string_view kPassable = ".GSE";
constexpr std::string_view kBlocked = "@OTW";
constexpr std::string_view kUsual = ".@T";  // characters that all tools interpret alike
constexpr std::size_t kHeaderLines = 4;

struct Size {
  int width = 0;
  int height = 0;
};

class MapReader {
 public:
  MapReader(const std::filesystem::path& path, std::vector<std::string>* warnings,
            const InputRules& rules)
      : file_(path.string()),
        text_(read_text(path)),
        lines_(split_lines(text_)),
        warnings_(warnings),
        rules_(rules) {}

  Grid read() {
    const Size size = read_header();
    require_rows(size.height);
    std::vector<bool> passable;
    passable.reserve(static_cast<std::size_t>(size.width) * size.height);
    for (int y = 0; y < size.height; ++y)
      read_row(kHeaderLines + y, static_cast<std::size_t>(size.width), passable);
    return Grid(size.width, size.height, passable);
  }

 private:
  // `line` and `column` count from 0.
  [[noreturn]] void fail(std::size_t line, std::size_t column, std::string_view message) const {
    throw InputError(file_, line_and_column(line + 1, column + 1), message);
  }

  std::string_view header_line(std::size_t line, std::string_view expected) const {
    if (line >= lines_.size())
      fail(line, 0, fmt::format("the file ends here; expected '{}'", expected));
    std::string_view text = lines_[line];
    while (text.ends_with(' ') || text.ends_with('\t')) text.remove_suffix(1);
    return text;
  }

  void expect_header(std::size_t line, std::string_view expected) const {
    if (const auto text = header_line(line, expected); text != expected)
      fail(line, 0, fmt::format("found '{}'; expected '{}'", one_line(text), expected));
  }

  // The number in header line `line`, which has the form "<key> <number>". Returns nullopt if the
  // line does not begin with the key.
  std::optional<int> number_after(std::size_t line, std::string_view key) const {
    const std::string_view text = header_line(line, "height' or 'width");
    if (!text.starts_with(key) || text.size() <= key.size() || text[key.size()] != ' ')
      return std::nullopt;
    const std::string_view digits = text.substr(key.size() + 1);
    const auto number = parse_number(digits, 1, kMaxMapCells);
    if (!number)
      fail(line, key.size() + 1,
           fmt::format("found '{}'; expected a {} from 1 to {}", one_line(digits), key,
                       kMaxMapCells));
    return number;
  }

  // Throws InputError if the file does not begin like a map. The message does not quote the file,
  // because the user may have named it by mistake.
  void expect_map() const {
    if (constexpr std::string_view kFirst = "type octile"; header_line(0, kFirst) != kFirst)
      fail(0, 0,
           fmt::format("is not a map; expected the first line '{}' ('grove convert' converts "
                       "drawings to maps)",
                       kFirst));
  }

  Size read_header() const {
    expect_map();
    Size size;
    for (std::size_t line = 1; line <= 2; ++line) {
      if (const auto height = number_after(line, "height"); height && size.height == 0)
        size.height = *height;
      else if (const auto width = number_after(line, "width"); width && size.width == 0)
        size.width = *width;
      else
        fail(line, 0,
             fmt::format("found '{}'; expected 'height' and 'width', one per line, each "
                         "with a number",
                         one_line(lines_[line])));
    }
    expect_header(3, "map");
    if (size.height > kMaxMapCells / size.width)
      fail(1, 0,
           fmt::format("found {} x {} cells; expected at most {}", size.width, size.height,
                       kMaxMapCells));
    require_memory(rules_, file_, line_and_column(2, 1), std::int64_t{size.width} * size.height,
                   "cells", kBytesPerCell);
    return size;
  }

  void require_rows(int height) const {
    const auto expected = kHeaderLines + static_cast<std::size_t>(height);
    if (lines_.size() < expected)
      fail(lines_.size(), 0,
           fmt::format("the map ends after {} rows; expected {}", lines_.size() - kHeaderLines,
                       height));
    if (lines_.size() > expected)
      fail(expected, 0, fmt::format("the map has more than {} rows; expected no more", height));
  }

  void read_row(std::size_t line, std::size_t width, std::vector<bool>& passable) {
    const std::string_view row = lines_[line];
    for (std::size_t x = 0; x < row.size() && x < width; ++x)
      passable.push_back(is_passable(line, x));
    if (row.size() != width)
      fail(line, std::min(row.size(), width),
           fmt::format("the row has {} characters; expected {}", row.size(), width));
  }

  bool is_passable(std::size_t line, std::size_t column) {
    const char c = lines_[line][column];
    if (c == '#')
      fail(line, column,
           "found '#'; expected '@' where the map is blocked, as in Moving AI's maps");
    const bool passable = kPassable.find(c) != std::string_view::npos;
    if (!passable && kBlocked.find(c) == std::string_view::npos)
      fail(line, column,
           fmt::format("unknown map character '{}'; expected one of . G S E (passable) or @ O T W "
                       "(blocked)",
                       one_line({&c, 1})));
    if (kUsual.find(c) == std::string_view::npos) warn_once(line, column, passable);
    return passable;
  }

  void warn_once(std::size_t line, std::size_t column, bool passable) {
    if (!warnings_ || warned_) return;
    warned_ = true;
    warnings_->push_back(
        fmt::format("{}: {}: '{}' is {} here; tools differ on characters other "
                    "than . @ T",
                    one_line(file_), line_and_column(line + 1, column + 1), lines_[line][column],
                    passable ? "passable" : "blocked"));
  }

  std::string file_;
  std::string text_;
  std::vector<std::string_view> lines_;
  std::vector<std::string>* warnings_;
  const InputRules& rules_;
  bool warned_ = false;
};

}  // namespace

Grid read_map(const std::filesystem::path& path, std::vector<std::string>* warnings,
              const InputRules& rules) {
  return MapReader(path, warnings, rules).read();
}

void write_map(const std::filesystem::path& path, const Grid& grid) {
  std::string text =
      fmt::format("type octile\nheight {}\nwidth {}\nmap\n", grid.height(), grid.width());
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) text += grid.passable(grid.cell({x, y})) ? '.' : '@';
    text += '\n';
  }
  write_file_atomically(path, text);
}

void write_bordered_csv(const std::filesystem::path& path, const Grid& grid) {
  std::string text = fmt::format("{},{}\n", grid.height() + 2, grid.width() + 2);
  for (int y = -1; y <= grid.height(); ++y) {
    for (int x = -1; x <= grid.width(); ++x) {
      const bool is_inside = x >= 0 && x < grid.width() && y >= 0 && y < grid.height();
      const bool passable = is_inside && grid.passable(grid.cell({x, y}));
      text += passable ? '0' : '1';
      text += x == grid.width() ? '\n' : ',';
    }
  }
  write_file_atomically(path, text);
}

}  // namespace grove::detail
