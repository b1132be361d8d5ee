// SPDX-License-Identifier: MIT
// JSON read strictly: a value that knows its file and its path, so that every complaint names both.
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

// A value inside a JsonDocument, which must outlive it. Every getter throws InputError when the
// value is not what it asks for.
class JsonValue {
 public:
  JsonValue(const nlohmann::json& json, const std::string& file, std::string path)
      : json_(&json), file_(&file), path_(std::move(path)) {}

  const nlohmann::json& json() const { return *json_; }
  const std::string& path() const { return path_; }
  const std::string& file() const { return *file_; }

  // Members of an object: one that must be there, and one that may be missing.
  JsonValue member(const char* key) const;
  std::optional<JsonValue> find(const char* key) const;

  // Elements of an array.
  std::size_t size() const;
  JsonValue element(std::size_t index) const;

  std::int64_t integer(std::int64_t least, std::int64_t most) const;
  double number() const;
  bool boolean() const;
  std::string text() const;
  std::vector<std::string> texts() const;
  // A cell [x, y]; both at least 0. And one of them.
  Position position() const;
  int coordinate() const;

  // "found 7; expected `expected`", as InputError here.
  [[noreturn]] void fail_expected(std::string_view expected) const;
  // `message` as InputError at this value, or at `field` below it.
  [[noreturn]] void fail(std::string_view message, std::string_view field = "") const;

 private:
  void require(bool condition, std::string_view expected) const;
  std::string path_to(std::string_view field) const;

  const nlohmann::json* json_;
  const std::string* file_;
  std::string path_;  // "" for the whole document
};

// A parsed file. Throws InputError unless it is one JSON object of bounded depth in which no object
// repeats a key.
class JsonDocument {
 public:
  explicit JsonDocument(const std::filesystem::path& path);
  // The same of a text; `name` stands for the file in complaints.
  JsonDocument(std::string_view text, std::string name);

  JsonValue root() const { return {json_, file_, ""}; }

 private:
  std::string file_;
  nlohmann::json json_;
};

// Of files of other tools, which may hold what does not concern Grove: collects one warning for
// each key that a reader does not know, however often the key occurs. (Grove's own files:
// known_keys.h.)
class UnknownKeys {
 public:
  UnknownKeys(std::string file, std::vector<std::string>* warnings)
      : file_(std::move(file)), warnings_(warnings) {}

  void look_at(const JsonValue& object, std::initializer_list<std::string_view> known);

 private:
  std::string file_;
  std::vector<std::string>* warnings_;  // may be null
  std::set<std::string> seen_;
};

}  // namespace grove::detail
