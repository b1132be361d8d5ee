// SPDX-License-Identifier: MIT
// Strict reading of JSON: each value stores its file name and JSON Pointer, so that every error
// message states both.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/grid.h"

namespace grove::detail {

// A value in a JsonDocument, which must outlive the value and must not be moved. Every getter
// throws InputError if the value does not have the requested type or range.
class JsonValue {
 public:
  JsonValue(const nlohmann::json& json, const std::string& file, std::string path)
      : json_(&json), file_(&file), path_(std::move(path)) {}

  const nlohmann::json& json() const { return *json_; }
  const std::string& path() const { return path_; }
  const std::string& file() const { return *file_; }

  // Members of an object. member() throws InputError if the key is missing; find() returns nullopt.
  JsonValue member(const char* key) const;
  std::optional<JsonValue> find(const char* key) const;

  // The elements of an array.
  std::size_t size() const;
  JsonValue element(std::size_t index) const;

  // `meaning_of_max`: appended to "expected an integer from 1 to 3", such as ", the number of
  // cells".
  std::int64_t integer(std::int64_t min, std::int64_t max,
                       std::string_view meaning_of_max = "") const;
  double number() const;
  bool boolean() const;
  std::string text() const;
  std::vector<std::string> texts() const;
  // position() reads a cell [x, y] with x, y >= 0, and coordinate() an integer >= 0.
  Position position() const;
  int coordinate() const;

  // Throws InputError "found 7; expected `expected`" at this value.
  [[noreturn]] void fail_expected(std::string_view expected) const;
  // Throws InputError `message` at this value, or at `field` below it.
  [[noreturn]] void fail(std::string_view message, std::string_view field = "") const;

 private:
  void require(bool condition, std::string_view expected) const;
  std::string path_to(std::string_view field) const;

  const nlohmann::json* json_;
  const std::string* file_;
  std::string path_;  // JSON Pointer; "" for the whole document
};

// A parsed JSON file. The constructors throw InputError if the file cannot be read, is not one JSON
// object, is nested too deeply, or contains an object that repeats a key.
class JsonDocument {
 public:
  explicit JsonDocument(const std::filesystem::path& path);
  // Parses the text of a file. `name` is the name of the file in messages.
  JsonDocument(std::string_view text, std::string name);

  JsonValue root() const { return {json_, file_, ""}; }

 private:
  std::string file_;
  nlohmann::json json_;
};

// Adds one warning for each distinct unknown key, for files of other tools, which may contain data
// that Grove does not use. (For Grove's own files see known_keys.h.)
class UnknownKeys {
 public:
  UnknownKeys(std::string file, std::vector<std::string>* warnings)
      : file_(std::move(file)), warnings_(warnings) {}

  void look_at(const JsonValue& object, std::initializer_list<std::string_view> known);

 private:
  std::string file_;
  std::vector<std::string>* warnings_;  // may be nullptr
  std::set<std::string> seen_;
};

}  // namespace grove::detail
