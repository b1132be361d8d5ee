// SPDX-License-Identifier: MIT
// Strict reading of YAML: each value stores its file name and position, so that every error message
// states both. The parser is yaml-cpp. However, numbers are parsed here, because yaml-cpp reads 010
// as 8 and 0x10 as 16, unlike other YAML parsers.
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/input_rules.h"
#include "model/grid.h"

namespace grove::detail {

// A value in a YamlDocument, which must outlive the value and must not be moved. Every getter
// throws InputError if the value does not have the requested type or range.
class YamlValue {
 public:
  YamlValue(YAML::Node node, const std::string& file) : node_(std::move(node)), file_(&file) {}

  const YAML::Node& node() const { return node_; }

  // Members of a map. member() throws InputError if the key is missing; find() returns nullopt.
  YamlValue member(std::string_view key) const;
  std::optional<YamlValue> find(std::string_view key) const;

  // The elements of a list. A missing value, as in "obstacles:", counts as an empty list.
  std::size_t size() const;
  YamlValue element(std::size_t index) const;

  int integer(int min, int max) const;
  // A scalar that is valid UTF-8 without NUL characters.
  std::string text() const;
  // A cell [x, y] with x, y >= 0. A tag, such as !!python/tuple, is ignored.
  Position position() const;

  // The position of the value in the file, such as "line 7, column 12".
  std::string place() const;
  // Throws InputError "found 7; expected `expected`" at this value.
  [[noreturn]] void fail_expected(std::string_view expected) const;
  [[noreturn]] void fail(std::string_view message) const;

 private:
  YAML::Node node_;
  const std::string* file_;
};

// A parsed YAML file. The constructor throws InputError if the file cannot be read, is not exactly
// one YAML document that is a map, is larger than 32 MiB, or needs more memory than `rules`
// permits.
class YamlDocument {
 public:
  explicit YamlDocument(const std::filesystem::path& path, const InputRules& rules = {});

  YamlValue root() const { return {root_, file_}; }

 private:
  std::string file_;
  YAML::Node root_;
};

// Adds one warning for each distinct unknown key.
class UnknownYamlKeys {
 public:
  UnknownYamlKeys(std::string file, std::vector<std::string>* warnings)
      : file_(std::move(file)), warnings_(warnings) {}

  void look_at(const YamlValue& map, std::initializer_list<std::string_view> known);

 private:
  std::string file_;
  std::vector<std::string>* warnings_;  // may be nullptr
  std::set<std::string> seen_;
};

}  // namespace grove::detail
