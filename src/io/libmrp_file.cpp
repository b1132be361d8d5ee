// SPDX-License-Identifier: MIT
#include "io/libmrp_file.h"

#include <fmt/format.h>

#include <iterator>
#include <optional>

#include "io/atomic_file.h"
#include "io/format_support.h"
#include "io/input_error.h"
#include "io/waypoints.h"
#include "io/yaml_text.h"
#include "io/yaml_value.h"

namespace grove::detail {
namespace {

// --- reading ---

// Limit on the number of cells, which a file of a few bytes in this format can request.
constexpr int kMaxCells = 1 << 24;

Grid read_grid(const YamlValue& map, const std::string& file, const InputRules& rules) {
  const YamlValue dimensions = map.member("dimensions");
  if (dimensions.size() != 2) dimensions.fail_expected("[columns, rows]");
  const int width = dimensions.element(0).integer(1, kMaxCells);
  const int height = dimensions.element(1).integer(1, kMaxCells);
  if (height > kMaxCells / width)
    dimensions.fail(
        fmt::format("found {} x {} cells; expected at most {}", width, height, kMaxCells));
  require_memory(rules, file, dimensions.place(), std::int64_t{width} * height, "cells",
                 kBytesPerCell);
  std::vector<bool> passable(static_cast<std::size_t>(width) * height, true);
  const YamlValue obstacles = map.member("obstacles");
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    const YamlValue value = obstacles.element(k);
    const Position p = value.position();
    if (p.x >= width || p.y >= height)
      value.fail(
          fmt::format("obstacle [{}, {}] is outside the map; expected x in 0..{} and y in "
                      "0..{}",
                      p.x, p.y, width - 1, height - 1));
    passable[static_cast<std::size_t>(p.y) * width + p.x] = false;
  }
  return Grid(width, height, passable);
}

// The destination of `agent`. Returns nullopt if it has none.
std::optional<YamlValue> find_goal(const YamlValue& agent) {
  const auto goal = agent.find("goal");
  const auto choice = agent.find("potentialGoals");
  const auto goals = agent.find("goals");
  if (goal.has_value() + choice.has_value() + goals.has_value() != 1)
    agent.fail("expected exactly one of the keys 'goal', 'goals' and 'potentialGoals'");
  if (!choice) return goal;
  if (choice->size() != 1)
    choice->fail(fmt::format(
        "found {} potential goals; expected one, because Grove does not choose destinations",
        choice->size()));
  return choice->element(0);
}

// The value in `agent` to which the field of an InstanceError refers.
YamlValue place_of(const YamlValue& agent, const std::optional<YamlValue>& goal,
                   const std::string& field) {
  if (field == "id") return agent.member("name");
  if (field == "start") return agent.member("start");
  return field == "goal" && goal ? *goal : agent;
}

void add_agent(InstanceBuilder& builder, const YamlValue& agent, Waypoints& waypoints) {
  const std::string name = agent.member("name").text();
  const Position start = agent.member("start").position();
  const auto goal = find_goal(agent);
  try {
    builder.add_agent(name, start, goal ? std::optional(goal->position()) : std::nullopt);
  } catch (const InstanceError& error) {
    place_of(agent, goal, error.field()).fail(error.what());
  }
  const auto goals = agent.find("goals");
  if (!goals) return;
  if (goals->size() == 0) goals->fail("there are no goals; expected at least one");
  for (std::size_t k = 0; k < goals->size(); ++k) {
    const YamlValue value = goals->element(k);
    waypoints.add(name, value.position(), value.place());
  }
}

// --- writing ---

std::string cell_text(const Grid& grid, Cell cell) {
  const Position p = grid.position(cell);
  return fmt::format("[{}, {}]", p.x, p.y);
}

std::string map_text(const Grid& grid) {
  std::string text =
      fmt::format("map:\n  dimensions: [{}, {}]\n  obstacles:", grid.width(), grid.height());
  if (grid.passable_count() == grid.cell_count()) return text + " []\n";
  text += '\n';
  for (Cell cell = 0; cell < grid.cell_count(); ++cell)
    if (!grid.passable(cell))
      fmt::format_to(std::back_inserter(text), "    - {}\n", cell_text(grid, cell));
  return text;
}

std::string head_text(const Grid& grid, const Agent& agent) {
  return fmt::format("  - name: {}\n    start: {}\n", yaml_text(agent.id),
                     cell_text(grid, agent.start));
}

void require_no_goals(const Instance& instance, std::string_view format) {
  for (AgentIndex i = 0; i < instance.agent_count(); ++i)
    if (instance.agent(i).goal)
      throw NotRepresentable(
          fmt::format("agents/{}", i),
          fmt::format(
              "agent '{}' has a goal to end on, which cannot be represented in {}; expected an "
              "agent that may end on any of its tasks (MG-MAPF)",
              instance.agent(i).id, format),
          Loss::kNothing);
}

void write_with_goals(const std::filesystem::path& path, const Instance& instance,
                      fmt::format_string<std::string> goal_line) {
  constexpr std::string_view kFormat = "libMultiRobotPlanning's YAML";
  require_free_grid(instance, kFormat);
  require_goals(instance, kFormat);
  require_no_tasks(instance, kFormat);
  std::string text = map_text(instance.grid()) + "agents:\n";
  for (const Agent& agent : instance.agents())
    text += head_text(instance.grid(), agent) +
            fmt::format(goal_line, cell_text(instance.grid(), *agent.goal));
  write_file_atomically(path, text);
}

}  // namespace

Instance read_libmrp_instance(const std::filesystem::path& path, std::vector<std::string>* warnings,
                              const InputRules& rules) {
  const YamlDocument document(path, rules);
  const YamlValue root = document.root();
  if (const auto roadmap = root.find("roadmap"))
    roadmap->fail("found a roadmap; expected a grid, given by the key 'map'");
  UnknownYamlKeys unknown(path.string(), warnings);
  unknown.look_at(root, {"map", "agents"});
  const YamlValue map = root.member("map");
  InstanceBuilder builder(read_grid(map, path.string(), rules));
  unknown.look_at(map, {"dimensions", "obstacles"});
  const YamlValue agents = root.member("agents");
  Waypoints waypoints(path.string());
  for (std::size_t i = 0; i < agents.size(); ++i) {
    add_agent(builder, agents.element(i), waypoints);
    unknown.look_at(agents.element(i), {"name", "start", "goal", "goals", "potentialGoals"});
  }
  waypoints.add_to(builder);
  try {
    return std::move(builder).build();
  } catch (const InstanceError& error) {
    agents.fail(error.what());
  }
}

void write_libmrp_instance(const std::filesystem::path& path, const Instance& instance) {
  write_with_goals(path, instance, "    goal: {}\n");
}

void write_potential_goals(const std::filesystem::path& path, const Instance& instance) {
  write_with_goals(path, instance, "    potentialGoals:\n      - {}\n");
}

void write_mgcbs_instance(const std::filesystem::path& path, const Instance& instance) {
  constexpr std::string_view kFormat = "MGCBS's YAML";
  require_free_grid(instance, kFormat);
  require_no_goals(instance, kFormat);
  require_work_for_all(instance, kFormat);
  require_distinct_cells(instance, kFormat);
  require_default_task_ids(instance, kFormat);
  std::string text = map_text(instance.grid()) + "agents:\n";
  for (const Agent& agent : instance.agents()) {
    text += head_text(instance.grid(), agent) + "    goals:\n";
    for (TaskIndex task : agent.tasks)
      text += fmt::format("      - {}\n", cell_text(instance.grid(), instance.task(task).cell));
  }
  write_file_atomically(path, text);
}

}  // namespace grove::detail
