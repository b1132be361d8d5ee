// SPDX-License-Identifier: MIT
#include "io/json_writer.h"

namespace grove::detail {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string compact(const OrderedJson& value) {
  return value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

template <typename DumpElement>
std::string dump_lines(const OrderedJson& value, const std::string& indent,
                       DumpElement dump_element) {
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

std::string dump_by_lines(const OrderedJson& document) {
  const auto dump_member = [](const OrderedJson& value) {
    return value.is_structured() ? dump_lines(value, "  ", compact) : compact(value);
  };
  return dump_lines(document, " ", dump_member) + "\n";
}

}  // namespace grove::detail
