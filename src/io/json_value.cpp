// SPDX-License-Identifier: MIT
#include "io/json_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "io/input_error.h"
#include "io/json_text.h"
#include "io/text_file.h"

namespace grove::detail {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kSchema = "$schema";  // schema reference, which editors use

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

// Returns the integer in `json`. Returns nullopt if it is not an integer from `min` to `max`.
// 3.0 is not an integer.
std::optional<std::int64_t> integer_within(const Json& json, std::int64_t min, std::int64_t max) {
  if (!json.is_number_integer()) return std::nullopt;
  constexpr std::uint64_t kLargest = std::numeric_limits<std::int64_t>::max();
  if (json.is_number_unsigned() && json.get<std::uint64_t>() > kLargest) return std::nullopt;
  const auto value = json.get<std::int64_t>();
  if (value < min || value > max) return std::nullopt;
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

std::int64_t JsonValue::integer(std::int64_t min, std::int64_t max,
                                std::string_view meaning_of_max) const {
  const auto value = integer_within(*json_, min, max);
  if (!value) fail_expected(fmt::format("an integer from {} to {}{}", min, max, meaning_of_max));
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
  return {element(0).coordinate(), element(1).coordinate()};
}

int JsonValue::coordinate() const {
  if (json_->is_number_float())
    fail_expected(
        "the column or row of a cell, a whole number; places on maps are cells, not "
        "metres");
  return static_cast<int>(integer(0, std::numeric_limits<int>::max()));
}

JsonDocument::JsonDocument(const std::filesystem::path& path)
    : JsonDocument(read_text(path), path.string()) {}

JsonDocument::JsonDocument(std::string_view text, std::string name)
    : file_(std::move(name)), json_(parse_json(text, file_)) {
  // The message does not quote the content, because the user may have named this file by mistake.
  if (!json_.is_object())
    root().fail(fmt::format("found {}; expected a JSON object", kind_of(json_)));
}

void UnknownKeys::look_at(const JsonValue& object, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : object.json().items()) {
    if (std::ranges::find(known, key) != known.end()) continue;
    if (key == kSchema || !seen_.insert(key).second) continue;
    if (warnings_)
      warnings_->push_back(fmt::format("{}: {}: unknown key '{}' is ignored", one_line(file_),
                                       object.path().empty() ? "/" : object.path(), one_line(key)));
  }
}

}  // namespace grove::detail
