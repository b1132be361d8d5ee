// SPDX-License-Identifier: MIT
#include "io/input_error.h"

#include <fmt/format.h>

#include <system_error>

namespace grove::detail {
namespace {

constexpr std::size_t kMaxLineLength = 400;

bool continues(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

// The length in bytes of the first character of `text`, which must not be empty; 0 if the character
// is not printable or not UTF-8.
std::size_t printable_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7F ? 1 : 0;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if (!continues(text[k])) return 0;
  return length;
}

std::string escaped(char c) {
  if (c == '\n') return "\\n";
  if (c == '\t') return "\\t";
  return fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
}

std::string joined(std::string_view file, std::string_view place, std::string_view message) {
  std::string line = one_line(file) + ": ";
  if (!place.empty()) line += one_line(place) + ": ";
  return line + one_line(message);
}

}  // namespace

InputError::InputError(std::string_view file, std::string_view place, std::string_view message)
    : std::runtime_error(joined(file, place, message)) {}

WrongFileKind::WrongFileKind(std::string_view file, std::string_view found,
                             std::string_view expected)
    : InputError(file, "/", fmt::format("found {}; expected {}", found, expected)), found_(found) {}

void fail_to_read(const std::filesystem::path& path, int error) {
  throw InputError(path.string(), "", "cannot be read: " + std::generic_category().message(error));
}

void fail_to_write(const std::filesystem::path& path, int error) {
  throw InputError(path.string(), "",
                   "cannot be written: " + std::generic_category().message(error));
}

std::string one_line(std::string_view text) {
  std::string line;
  while (!text.empty()) {
    if (line.size() >= kMaxLineLength) return line + "...";
    const std::size_t length = printable_length(text);
    line += length > 0 ? std::string(text.substr(0, length)) : escaped(text.front());
    text.remove_prefix(length > 0 ? length : 1);
  }
  return line;
}

}  // namespace grove::detail
