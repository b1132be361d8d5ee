// SPDX-License-Identifier: MIT
#include "io/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "io/input_error.h"

namespace grove::detail {
namespace {

constexpr std::size_t kLargestFile = std::size_t{1} << 30;  // also stops reading /dev/zero
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

}  // namespace

std::string read_text(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) fail_to_read(path);
  if (std::filesystem::is_directory(path))
    throw InputError(path.string(), "", "is a folder; expected a file");
  std::string text;
  char block[1 << 16];
  while (const std::size_t size = std::fread(block, 1, sizeof block, file.get())) {
    text.append(block, size);
    if (text.size() > kLargestFile)
      throw InputError(path.string(), "", "is too large; expected at most 1 GiB");
  }
  if (std::ferror(file.get())) fail_to_read(path);
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return text;
}

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
  }
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  return lines;
}

std::string line_and_column(std::size_t line, std::size_t column) {
  return fmt::format("line {}, column {}", line, column);
}

std::string line_and_column_at(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const auto line = static_cast<std::size_t>(std::ranges::count(before, '\n')) + 1;
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 == 0: the first line
  return line_and_column(line, before.size() - line_start + 1);
}

LineStarts::LineStarts(std::string_view text) : starts_{0} {
  for (std::size_t end = text.find('\n'); end != std::string_view::npos;
       end = text.find('\n', end + 1))
    starts_.push_back(end + 1);
}

std::string LineStarts::place(std::size_t offset) const {
  const auto line = std::ranges::upper_bound(starts_, offset) - starts_.begin();
  return line_and_column(static_cast<std::size_t>(line), offset - starts_[line - 1] + 1);
}

bool is_utf8(const std::string& text) {
  try {
    return !nlohmann::json(text).dump().empty();
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

}  // namespace grove::detail
