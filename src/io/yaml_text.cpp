// SPDX-License-Identifier: MIT
#include "io/yaml_text.h"

#include <yaml-cpp/emitter.h>
#include <yaml-cpp/emittermanip.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace grove::detail {
namespace {

// Words that YAML 1.1 reads as a Boolean or null, in upper or lower case.
constexpr std::array<std::string_view, 9> kWords = {"y",   "n",    "yes",   "no",  "on",
                                                    "off", "true", "false", "null"};

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// True if `text` is a letter followed by letters, digits, - and _, and is not one of kWords.
bool is_plain(const std::string& text) {
  const auto fits = [](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  std::string lower = text;
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return !text.empty() && is_letter(text.front()) && std::ranges::all_of(text, fits) &&
         std::ranges::find(kWords, lower) == kWords.end();
}

}  // namespace

std::string yaml_text(const std::string& text) {
  if (is_plain(text)) return text;
  YAML::Emitter emitter;
  emitter.SetOutputCharset(YAML::EscapeNonAscii);  // some others end a line in YAML 1.1 only
  emitter << YAML::DoubleQuoted << text;
  return emitter.c_str();
}

}  // namespace grove::detail
