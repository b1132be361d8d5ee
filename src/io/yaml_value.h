// SPDX-License-Identifier: MIT
// YAML read strictly: a value that knows its file and its place there, so that every complaint
// names both. The parser is yaml-cpp's; numbers are not, for it takes 010 for 8 and 0x10 for 16,
// where other readers of YAML do not.
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

// A value inside a YamlDocument, which must outlive it. Every getter throws InputError when the
// value is not what it asks for.
class YamlValue {
 public:
  YamlValue(YAML::Node node, const std::string& file) : node_(std::move(node)), file_(&file) {}

  const YAML::Node& node() const { return node_; }

  // Members of a map: one that must be there, and one that may be missing.
  YamlValue member(std::string_view key) const;
  std::optional<YamlValue> find(std::string_view key) const;

  // Elements of a list. Nothing at all ("obstacles:") is an empty one.
  std::size_t size() const;
  YamlValue element(std::size_t index) const;

  int integer(int least, int most) const;
  // A scalar that is valid UTF-8 and holds no NUL.
  std::string text() const;
  // A cell [x, y]; both at least 0. Its tag, if any, is not looked at (!!python/tuple).
  Position position() const;

  // "line 7, column 12"
  std::string place() const;
  // "found 7; expected `expected`", as InputError here.
  [[noreturn]] void fail_expected(std::string_view expected) const;
  [[noreturn]] void fail(std::string_view message) const;

 private:
  YAML::Node node_;
  const std::string* file_;
};

// A parsed file. Throws InputError unless it is one YAML document that is a map.
class YamlDocument {
 public:
  explicit YamlDocument(const std::filesystem::path& path, const InputRules& rules = {});

  YamlValue root() const { return {root_, file_}; }

 private:
  std::string file_;
  YAML::Node root_;
};

// Collects one warning for each key that a reader does not know, however often the key occurs.
class UnknownYamlKeys {
 public:
  UnknownYamlKeys(std::string file, std::vector<std::string>* warnings)
      : file_(std::move(file)), warnings_(warnings) {}

  void look_at(const YamlValue& map, std::initializer_list<std::string_view> known);

 private:
  std::string file_;
  std::vector<std::string>* warnings_;  // may be null
  std::set<std::string> seen_;
};

}  // namespace grove::detail
