// SPDX-License-Identifier: MIT
#include "json_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <utility>

#include "grove/detail/io/input_error.h"
#include "grove/detail/io/text_file.h"
#include "json_parser.h"

namespace grove::detail {
namespace {

using Json = nlohmann::json;

std::string description(const Json& json) {
  if (json.is_array()) return "an array";
  if (json.is_object()) return "an object";
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string_view kind_of(const Json& json) {
  if (json.is_array()) return "an array";
  if (json.is_null()) return "null";
  if (json.is_boolean()) return "true or false";
  return json.is_number() ? "a number" : "a string";
}

// The integer that `json` holds, if it is one from `least` to `most`. 3.0 is none: strict.
std::optional<std::int64_t> integer_within(const Json& json, std::int64_t least,
                                           std::int64_t most) {
  if (!json.is_number_integer()) return std::nullopt;
  constexpr std::uint64_t kLargest = std::numeric_limits<std::int64_t>::max();
  if (json.is_number_unsigned() && json.get<std::uint64_t>() > kLargest) return std::nullopt;
  const auto value = json.get<std::int64_t>();
  if (value < least || value > most) return std::nullopt;
  return value;
}

}  // namespace

std::string JsonValue::path_to(std::string_view field) const {
  return field.empty() ? path_ : fmt::format("{}/{}", path_, field);
}

void JsonValue::fail(std::string_view message, std::string_view field) const {
  const std::string place = path_to(field);
  throw InputError(*file_, place.empty() ? "/" : place, message);
}

void JsonValue::fail_expected(std::string_view expected) const {
  fail(fmt::format("found {}; expected {}", one_line(description(*json_)), expected));
}

void JsonValue::require(bool condition, std::string_view expected) const {
  if (!condition) fail_expected(expected);
}

JsonValue JsonValue::member(const char* key) const {
  auto value = find(key);
  if (!value) fail(fmt::format("key '{}' is missing; expected it in this object", key));
  return *std::move(value);
}

std::optional<JsonValue> JsonValue::find(const char* key) const {
  require(json_->is_object(), "an object");
  const auto it = json_->find(key);
  if (it == json_->end()) return std::nullopt;
  return JsonValue(*it, *file_, path_to(key));
}

std::size_t JsonValue::size() const {
  require(json_->is_array(), "an array");
  return json_->size();
}

JsonValue JsonValue::element(std::size_t index) const {
  return {(*json_)[index], *file_, path_to(std::to_string(index))};
}

std::int64_t JsonValue::integer(std::int64_t least, std::int64_t most) const {
  const auto value = integer_within(*json_, least, most);
  if (!value) fail_expected(fmt::format("an integer from {} to {}", least, most));
  return *value;
}

double JsonValue::number() const {
  require(json_->is_number(), "a number");
  return json_->get<double>();
}

bool JsonValue::boolean() const {
  require(json_->is_boolean(), "true or false");
  return json_->get<bool>();
}

std::string JsonValue::text() const {
  require(json_->is_string(), "a string");
  std::string text = json_->get<std::string>();
  require(text.find('\0') == std::string::npos, "a string without NUL characters");
  return text;
}

std::vector<std::string> JsonValue::texts() const {
  std::vector<std::string> all;
  for (std::size_t k = 0; k < size(); ++k) all.push_back(element(k).text());
  return all;
}

Position JsonValue::position() const {
  require(json_->is_array() && json_->size() == 2, "a cell [x, y]");
  constexpr int kMost = std::numeric_limits<int>::max();
  const auto x = integer_within((*json_)[0], 0, kMost);
  const auto y = integer_within((*json_)[1], 0, kMost);
  if (!x || !y) element(x ? 1 : 0).integer(0, kMost);  // throws, with the path
  return {static_cast<int>(*x), static_cast<int>(*y)};
}

JsonDocument::JsonDocument(const std::filesystem::path& path)
    : JsonDocument(read_text(path), path.string()) {}

JsonDocument::JsonDocument(std::string_view text, std::string name)
    : file_(std::move(name)), json_(parse_json(text, file_)) {
  // (What it holds instead is not told: the file may be none that anyone meant to show.)
  if (!json_.is_object())
    root().fail(fmt::format("found {}; expected a JSON object", kind_of(json_)));
  json_.erase("$schema");
}

namespace {

// "One-Ways" as "oneway".
std::string bare(std::string_view key) {
  std::string text;
  for (const char c : key)
    if (c != '_' && c != '-' && c != ' ')
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (text.size() > 1 && text.back() == 's') text.pop_back();
  return text;
}

// Do two words become one by one letter more, less or other, or by two in the other order?
bool differ_by_one(std::string_view a, std::string_view b) {
  if (a.size() > b.size()) std::swap(a, b);
  if (b.size() - a.size() > 1) return false;
  const auto [at_a, at_b] = std::ranges::mismatch(a, b);
  const auto rest_a = std::string_view(at_a, a.end());
  const auto rest_b = std::string_view(at_b, b.end());
  if (rest_b.empty()) return true;
  if (a.size() < b.size()) return rest_a == rest_b.substr(1);
  const bool other_order = rest_a.size() > 1 && rest_a[0] == rest_b[1] && rest_a[1] == rest_b[0] &&
                           rest_a.substr(2) == rest_b.substr(2);
  return other_order || rest_a.substr(1) == rest_b.substr(1);
}

constexpr std::size_t kLeastMisspelt = 4;  // shorter ones are near to too much

bool is_misspelt(const std::string& key, std::string_view known) {
  const std::string a = bare(key);
  const std::string b = bare(known);
  return a == b || (std::min(a.size(), b.size()) >= kLeastMisspelt && differ_by_one(a, b));
}

}  // namespace

void UnknownKeys::look_at(const JsonValue& object, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : object.json().items()) {
    if (std::ranges::find(known, key) != known.end()) continue;
    if (misspelt_ == Misspelt::kRefused)
      for (const std::string_view meant : known)
        if (!object.json().contains(meant) && is_misspelt(key, meant))
          object.fail(fmt::format("unknown key '{}'; expected '{}', if that is what it means",
                                  one_line(key), meant));
    if (!seen_.insert(key).second) continue;
    if (warnings_)
      warnings_->push_back(fmt::format("{}: {}: unknown key '{}' is ignored", one_line(file_),
                                       object.path().empty() ? "/" : object.path(), one_line(key)));
  }
}

}  // namespace grove::detail
