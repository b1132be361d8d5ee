// SPDX-License-Identifier: MIT
#include "tools/common/parse_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

namespace grove::detail {
namespace {

using Words = std::vector<std::string>;

constexpr std::size_t kMostTypos = 2;
constexpr std::size_t kShortest = 4;  // of what resembles only few others

// Levenshtein's distance: letters to add, drop or change.
std::size_t distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t changed = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

Words commands_of(const CLI::App& app) {
  Words names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

Words options_of(const CLI::App& app) {
  Words names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string unknown_text(const CLI::App& command) {
  const Words words = command.remaining();
  const auto option =
      std::ranges::find_if(words, [](const std::string& word) { return word.starts_with('-'); });
  if (option == words.end()) return fmt::format("unexpected argument '{}'", words.front());
  const std::string name = option->substr(0, option->find('='));
  return fmt::format("unknown option '{}'{}", name, suggestion(name, options_of(command)));
}

}  // namespace

std::string suggestion(const std::string& word, const Words& known) {
  if (word.size() < kShortest) return {};
  const auto typos = [&](const std::string& name) { return distance(word, name); };
  const auto nearest = std::ranges::min_element(known, {}, typos);
  if (nearest == known.end() || typos(*nearest) > kMostTypos) return {};
  return fmt::format("; did you mean '{}'?", *nearest);
}

std::string parse_error_text(const CLI::App& command, const CLI::ParseError& error) {
  if (command.remaining_size() == 0) return error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) return unknown_text(command);
  const bool wants_command = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr &&
                             command.get_require_subcommand_min() > 0;
  if (!wants_command) return error.what();  // CLI11 would only say that one is required
  return unknown_command_text(command, command.remaining().front());
}

std::string unknown_command_text(const CLI::App& command, const std::string& word) {
  return fmt::format("unknown command '{}'{}", word, suggestion(word, commands_of(command)));
}

}  // namespace grove::detail
