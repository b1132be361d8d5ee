// SPDX-License-Identifier: MIT
#include "tools/solve/assignment_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

namespace grove::detail {
namespace {

constexpr std::size_t kMaxAgents = 12;  // with a line of their own
constexpr std::size_t kMaxWidth = 52;   // characters of a list of ids; the first id is not cut

// Joins ids with commas. A list that is too long ends with the number of all ids: "a, b, ... (20
// tasks)".
std::string cut_list(const std::vector<std::string>& ids, std::string_view what) {
  std::string text;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const bool fits = text.size() + ids[i].size() <= kMaxWidth;
    if (i > 0 && !fits) return fmt::format("{}, ... ({} {})", text, ids.size(), what);
    text += (i > 0 ? ", " : "") + ids[i];
  }
  return text;
}

// True if the line of the agent would say no more than the instance does.
bool is_idle(const Agent& agent, const AgentPlan& plan) {
  return plan.sequence.empty() && agent.goals.empty();
}

// Returns a cell as "[3, 1]", and a vertex as its id.
std::string place_text(const Instance& instance, Place place) {
  const Roadmap* roadmap = instance.roadmap();
  if (roadmap && static_cast<std::size_t>(place) < roadmap->vertices().size())
    return roadmap->vertices()[static_cast<std::size_t>(place)].id;
  return instance.world().name(place);
}

std::string agent_line(const Instance& instance, const Agent& agent, const AgentPlan& plan) {
  std::vector<std::string> tasks;
  for (const TaskIndex task : plan.sequence) tasks.push_back(instance.task(task).id);
  return fmt::format("{}: {} -> {}", agent.id, tasks.empty() ? "no task" : cut_list(tasks, "tasks"),
                     place_text(instance, instance.pose_of(plan.path.back()).place));
}

}  // namespace

std::vector<std::string> assignment_summary(const Instance& instance, const Plan& plan) {
  if (!instance.has_choices()) return {};
  std::vector<std::string> lines;
  std::vector<std::string> idle;
  std::size_t left_out = 0;
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const Agent& agent = instance.agent(i);
    const AgentPlan& path = plan.agents[static_cast<std::size_t>(i)];
    if (is_idle(agent, path))
      idle.push_back(agent.id);
    else if (lines.size() < kMaxAgents)
      lines.push_back(agent_line(instance, agent, path));
    else
      ++left_out;
  }
  if (left_out > 0)
    lines.push_back(
        fmt::format("{} more agent{}: see the plan file", left_out, left_out == 1 ? "" : "s"));
  if (!idle.empty()) lines.push_back("no task: " + cut_list(idle, "agents"));
  for (std::size_t i = 0; i < lines.size(); ++i)
    lines[i] = (i == 0 ? "Assignment    " : std::string(14, ' ')) + lines[i];
  return lines;
}

}  // namespace grove::detail
