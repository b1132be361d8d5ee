// SPDX-License-Identifier: MIT
#include "json_writer.h"

namespace grove {
namespace {

using Json = nlohmann::ordered_json;

std::string compact(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

template <typename DumpElement>
std::string dump_lines(const Json& value, const std::string& indent, DumpElement dump_element) {
  const bool is_object = value.is_object();
  std::string text = is_object ? "{" : "[";
  std::string separator = "\n" + indent;
  for (const auto& [key, element] : value.items()) {
    text += separator + (is_object ? compact(key) + ": " : "") + dump_element(element);
    separator = ",\n" + indent;
  }
  return text + (is_object ? "}" : "]");
}

}  // namespace

std::string dump_by_lines(const Json& document) {
  const auto dump_member = [](const Json& value) {
    return value.is_structured() ? dump_lines(value, "  ", compact) : compact(value);
  };
  return dump_lines(document, " ", dump_member) + "\n";
}

}  // namespace grove
