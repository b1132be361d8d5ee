// SPDX-License-Identifier: MIT
#include "tools/execute/robots.h"

#include <fmt/format.h>

#include <CLI/Error.hpp>
#include <algorithm>
#include <vector>

#include "io/input_error.h"
#include "io/plan_file.h"

namespace grove::detail {

void refuse(const std::string& option, const std::string& text, const std::string& expected) {
  throw CLI::ValidationError(option,
                             fmt::format("found '{}'; expected {}", one_line(text), expected));
}

AgentIndex robot_of(const std::string& option, const std::string& text, const std::string& id,
                    const Instance& instance) {
  const auto found = std::ranges::find(instance.agents(), id, &Agent::id);
  if (found == instance.agents().end())
    refuse(option, text,
           fmt::format("a robot of the instance before '{}'", text.substr(id.size())));
  return static_cast<AgentIndex>(found - instance.agents().begin());
}

ClaimedPlan read_plan_to_execute(const std::string& file, const Instance& instance) {
  ClaimedPlan claimed = read_plan_of_any_tool(file, instance);
  const auto wrong = check_in_file(instance, claimed.solution, claimed.order, 1);
  if (wrong.empty()) return claimed;
  const bool is_made_otherwise = claimed.solution.may_follow && !instance.may_follow();
  throw InputError(
      file, wrong.front().json_pointer,
      fmt::format("is not valid{}, so it cannot be driven: {}",
                  is_made_otherwise ? " with --no-following, and was made without it" : "",
                  wrong.front().message));
}

}  // namespace grove::detail
