// SPDX-License-Identifier: MIT
#include "io/yaml_value.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "io/input_error.h"
#include "io/text_file.h"
#include "model/parse_number.h"

namespace grove::detail {
namespace {

// Maximum size of a file in bytes, which is sufficient for more than a million obstacles.
constexpr std::size_t kLargestYaml = std::size_t{32} << 20;
constexpr std::size_t kBytesPerByte = 150;  // memory for the parser's nodes per byte of text

std::string place_of(const YAML::Mark& mark) {
  if (mark.is_null()) return "";
  return line_and_column(static_cast<std::size_t>(mark.line) + 1,
                         static_cast<std::size_t>(mark.column) + 1);
}

std::string description(const YAML::Node& node) {
  if (node.IsSequence()) return "a list";
  if (node.IsMap()) return "a map";
  if (node.IsScalar()) return fmt::format("'{}'", one_line(node.Scalar()));
  return "nothing";
}

// The value of a decimal integer. Returns nullopt if the text is not an integer or has leading
// zeros.
std::optional<int> decimal(const std::string& text) {
  const std::string_view digits = std::string_view(text).substr(text.starts_with('-') ? 1 : 0);
  const bool is_padded = digits.size() > 1 && digits.front() == '0';
  return is_padded ? std::nullopt : parse_number<int>(text);
}

// Ignores all events of the parser.
class IgnoringHandler : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

// Throws InputError if the text has more than one document, because Load() would ignore all but the
// first. LoadAll() is not used, because it finds empty documents forever after a stray comma.
void require_one_document(const std::string& file, const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  IgnoringHandler handler;
  if (!parser.HandleNextDocument(handler))
    throw InputError(file, "", "is empty; expected a YAML map");
  if (parser.HandleNextDocument(handler))
    throw InputError(file, "", "has more than one YAML document; expected one");
}

}  // namespace

std::string YamlValue::place() const {
  return place_of(node_.Mark());
}

void YamlValue::fail(std::string_view message) const {
  throw InputError(*file_, place(), message);
}

void YamlValue::fail_expected(std::string_view expected) const {
  fail(fmt::format("found {}; expected {}", description(node_), expected));
}

YamlValue YamlValue::member(std::string_view key) const {
  auto value = find(key);
  if (!value) fail(fmt::format("key '{}' is missing; expected it in this map", key));
  return *std::move(value);
}

std::optional<YamlValue> YamlValue::find(std::string_view key) const {
  if (!node_.IsMap()) fail_expected("a map");
  std::optional<YamlValue> found;
  for (const auto& entry : node_) {
    const YAML::Node& name = entry.first;
    if (!name.IsScalar() || name.Scalar() != key) continue;
    if (found)
      YamlValue(name, *file_)
          .fail(fmt::format("key '{}' appears twice; expected distinct keys", key));
    found.emplace(entry.second, *file_);
  }
  return found;
}

std::size_t YamlValue::size() const {
  if (node_.IsNull()) return 0;
  if (!node_.IsSequence()) fail_expected("a list");
  return node_.size();
}

YamlValue YamlValue::element(std::size_t index) const {
  return {node_[index], *file_};
}

int YamlValue::integer(int min, int max) const {
  const auto value = node_.IsScalar() ? decimal(node_.Scalar()) : std::nullopt;
  if (!value || *value < min || *value > max)
    fail_expected(fmt::format("a decimal integer from {} to {}", min, max));
  return *value;
}

std::string YamlValue::text() const {
  if (!node_.IsScalar()) fail_expected("a text");
  if (node_.Scalar().find('\0') != std::string::npos || !is_utf8(node_.Scalar()))
    fail_expected("a text in UTF-8 without NUL characters");
  return node_.Scalar();
}

Position YamlValue::position() const {
  if (!node_.IsSequence() || node_.size() != 2) fail_expected("a cell [x, y]");
  constexpr int kMaxInt = std::numeric_limits<int>::max();
  return {element(0).integer(0, kMaxInt), element(1).integer(0, kMaxInt)};
}

YamlDocument::YamlDocument(const std::filesystem::path& path, const InputRules& rules)
    : file_(path.string()) {
  const std::string text = read_text(path);
  if (text.size() > kLargestYaml)
    throw InputError(file_, "", "is too large; expected at most 32 MiB of YAML");
  require_memory(rules, file_, "", std::ssize(text), "bytes of YAML", kBytesPerByte);
  try {
    require_one_document(file_, text);
    root_ = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw InputError(file_, place_of(error.mark),
                     fmt::format("malformed YAML: {}; expected a YAML map", error.msg));
  }
  if (!root_.IsMap()) root().fail_expected("a map with the keys 'map' and 'agents'");
}

void UnknownYamlKeys::look_at(const YamlValue& map, std::initializer_list<std::string_view> known) {
  for (const auto& entry : map.node()) {
    const YAML::Node& name = entry.first;
    const std::string key = name.IsScalar() ? name.Scalar() : "?";
    if (std::ranges::find(known, key) != known.end() || !seen_.insert(key).second) continue;
    if (warnings_)
      warnings_->push_back(fmt::format("{}: {}: unknown key '{}' is ignored", one_line(file_),
                                       place_of(name.Mark()), one_line(key)));
  }
}

}  // namespace grove::detail
