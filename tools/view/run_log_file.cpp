// SPDX-License-Identifier: MIT
#include "tools/view/run_log_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "io/input_error.h"
#include "io/text_file.h"

namespace grove::detail {
namespace {

constexpr const char* kHeader =
    "expected the header of a log, as 'grove solve --log FILE --log-format jsonl' "
    "writes it";

// Returns the name of the event, or "" if the line is no event.
std::string event_of(std::string_view line) {
  const auto json = nlohmann::json::parse(line, nullptr, false);
  if (!json.is_object()) return "";
  const auto event = json.find("event");
  return event != json.end() && event->is_string() ? event->get<std::string>() : "";
}

}  // namespace

std::string read_run_log(const std::filesystem::path& path) {
  std::string text = read_text(path);
  text.resize(text.rfind('\n') + 1);  // "" if there is no newline: npos + 1 is 0
  if (text.empty()) throw InputError(path.string(), "", fmt::format("is empty; {}", kHeader));
  std::size_t number = 0;
  for (const std::string_view line : split_lines(text)) {
    const std::string event = event_of(line);
    const std::string place = fmt::format("line {}", ++number);
    if (number == 1 && event != "header") throw InputError(path.string(), place, kHeader);
    if (event.empty())
      throw InputError(path.string(), place, "expected an object with a text \"event\"");
  }
  return text;
}

}  // namespace grove::detail
