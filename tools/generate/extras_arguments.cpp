// SPDX-License-Identifier: MIT
#include "tools/generate/extras_arguments.h"

#include <fmt/format.h>

#include <string>

#include "tools/common/options.h"

namespace grove::detail {
namespace {

// Parses the range of task durations in time steps, "0-10" or "5".
Extras::Range parse_durations(const std::string& option, const std::string& text) {
  const IntegerRange steps{0, InstanceBuilder::kMaxDuration};
  const std::size_t dash = text.find('-', 1);
  const std::int64_t least = parse_integer(option, text.substr(0, dash), steps);
  const std::int64_t most =
      dash == std::string::npos ? least : parse_integer(option, text.substr(dash + 1), steps);
  if (least > most)
    throw CLI::ValidationError(option,
                               fmt::format("found '{}'; expected the smaller number first", text));
  return {static_cast<Time>(least), static_cast<Time>(most)};
}

}  // namespace

void ExtrasArguments::add_to(CLI::App& command) {
  command_ = &command;
  command.add_flag("--turning", turning_,
                   "let agents move only forward, with time for each quarter turn; draw their "
                   "headings at the start");
  add_integer(command, "--turn-steps", turn_steps_, {1, InstanceBuilder::kMaxDuration},
              "with --turning: duration of a quarter turn, steps");
  command.add_flag("--goal-headings", goal_headings_,
                   "with --turning: draw headings at the destinations as well");
  const std::string name = "--durations";
  command
      .add_option(
          name,
          [this, name](const CLI::results_t& results) {
            durations_ = parse_durations(name, results.front());
            return true;
          },
          "range of the duration of tasks, steps; drawn for each task, integers from A to B")
      ->type_name("A-B")
      ->default_str("0-0");
}

Extras ExtrasArguments::extras(bool with_goals) const {
  for (const char* option : {"--turn-steps", "--goal-headings"})
    if (!turning_ && command_->count(option) > 0)
      throw CLI::ValidationError(option, "allowed only with --turning");
  if (goal_headings_ && !with_goals)
    throw CLI::ValidationError("--goal-headings", "allowed only if some agents have destinations");
  return {.turn_steps = turning_ ? static_cast<Time>(turn_steps_) : 0,
          .goal_headings = goal_headings_,
          .durations = durations_};
}

}  // namespace grove::detail
