// SPDX-License-Identifier: MIT
#include "grove/io/instance_file.h"

#include <fmt/format.h>

#include "grove/io/atomic_file.h"
#include "grove/io/expressible.h"
#include "grove/io/input_error.h"
#include "grove/io/map_file.h"
#include "grove/io/scenario_file.h"
#include "grove/io/text_file.h"
#include "grove/model/distance_field.h"
#include "json_value.h"
#include "json_writer.h"

namespace grove {
namespace {

using OrderedJson = nlohmann::ordered_json;

// Runs `add`; tells where in the file the rule was broken that an InstanceError reports.
template <typename Add>
void at_place_of(const JsonValue& value, Add add) {
  try {
    add();
  } catch (const InstanceError& error) {
    value.fail(error.what(), error.field());
  }
}

void add_agent(InstanceBuilder& builder, const JsonValue& agent) {
  const std::string id = agent.member("id").text();
  const Position start = agent.member("start").position();
  std::optional<Position> goal;
  if (const auto value = agent.find("goal")) goal = value->position();
  at_place_of(agent, [&] { builder.add_agent(id, start, goal); });
}

void add_task(InstanceBuilder& builder, const JsonValue& task) {
  const std::string id = task.member("id").text();
  const Position cell = task.member("cell").position();
  const std::vector<std::string> agents = task.member("agents").texts();
  at_place_of(task, [&] { builder.add_task(id, cell, agents); });
}

void add_all(InstanceBuilder& builder, const JsonValue& root, UnknownKeys& unknown) {
  const JsonValue agents = root.member("agents");
  for (std::size_t i = 0; i < agents.size(); ++i) {
    add_agent(builder, agents.element(i));
    unknown.look_at(agents.element(i), {"id", "start", "goal"});
  }
  const JsonValue tasks = root.member("tasks");
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    add_task(builder, tasks.element(i));
    unknown.look_at(tasks.element(i), {"id", "cell", "agents"});
  }
}

void add_row(InstanceBuilder& builder, const std::string& file, const ScenarioRow& row,
             const std::string& id) {
  try {
    builder.add_agent(id, row.start, row.goal);
  } catch (const InstanceError& error) {
    throw InputError(file, fmt::format("line {}, {}", row.line, error.field()), error.what());
  }
}

// The row of agent `i`, and the steps from its start to its destination.
std::pair<ScenarioRow, Time> row_of(const Instance& instance, AgentIndex i,
                                    const std::string& map) {
  const Grid& grid = instance.grid();
  const Agent& agent = instance.agent(i);
  const Time length = distance_field(grid, *agent.goal)[agent.start];
  if (length >= kNever)
    throw NotExpressible(fmt::format("agents/{}", i),
                         fmt::format("agent '{}' cannot reach its goal; expected a way there, for "
                                     "a .scen file tells how long it is",
                                     agent.id),
                         Loss::kNothing);
  return {{.line = i + 2,
           .map = map,
           .width = grid.width(),
           .height = grid.height(),
           .start = grid.position(agent.start),
           .goal = grid.position(*agent.goal)},
          length};
}

OrderedJson cell_json(const Grid& grid, Cell cell) {
  const Position p = grid.position(cell);
  return {p.x, p.y};
}

OrderedJson agent_json(const Instance& instance, const Agent& agent) {
  OrderedJson json{{"id", agent.id}, {"start", cell_json(instance.grid(), agent.start)}};
  if (agent.goal) json["goal"] = cell_json(instance.grid(), *agent.goal);
  return json;
}

OrderedJson task_json(const Instance& instance, const Task& task) {
  OrderedJson ids = OrderedJson::array();
  for (AgentIndex agent : task.agents) ids.push_back(instance.agent(agent).id);
  return {{"id", task.id}, {"cell", cell_json(instance.grid(), task.cell)}, {"agents", ids}};
}

}  // namespace

LoadedInstance read_instance(const std::filesystem::path& path) {
  return parse_instance(read_text(path), path.string(), path.parent_path());
}

LoadedInstance parse_instance(std::string_view text, const std::string& name,
                              const std::filesystem::path& folder) {
  const JsonDocument document(text, name);
  const JsonValue root = document.root();
  std::vector<std::string> warnings;
  UnknownKeys unknown(name, &warnings);
  unknown.look_at(root, {"map", "agents", "tasks"});

  const JsonValue map = root.member("map");
  if (map.text().empty()) map.fail_expected("the name of a map file");
  std::filesystem::path map_path = folder / map.text();
  if (!std::filesystem::is_regular_file(map_path))
    map.fail(fmt::format(
        "{} '{}'; expected a map, relative to {}",
        std::filesystem::is_directory(map_path) ? "found the folder" : "there is no file",
        map_path.string(), folder.empty() ? "the current folder" : "this file"));
  InstanceBuilder builder(read_map(map_path, &warnings));
  add_all(builder, root, unknown);
  std::optional<Instance> instance;
  at_place_of(root, [&] { instance = std::move(builder).build(); });
  return {*std::move(instance), std::move(map_path), std::move(warnings)};
}

LoadedInstance read_scenario_instance(const std::filesystem::path& scenario,
                                      const std::filesystem::path& map, int agents) {
  const std::string file = scenario.string();
  const std::vector<ScenarioRow> rows = read_scenario(scenario);
  if (agents < 1) throw InputError(file, "", "expected at least one agent");
  if (rows.size() < static_cast<std::size_t>(agents))
    throw InputError(
        file, "",
        fmt::format("has {} rows; expected at least {}, one per agent", rows.size(), agents));
  std::vector<std::string> warnings;
  const Grid grid = read_map(map, &warnings);
  require_same_map(scenario, {rows.data(), static_cast<std::size_t>(agents)}, map, grid);
  InstanceBuilder builder(grid);
  for (int i = 0; i < agents; ++i) add_row(builder, file, rows[i], default_agent_id(i));
  return {std::move(builder).build(), map, std::move(warnings)};
}

void write_scenario_instance(const std::filesystem::path& path, const Instance& instance,
                             const std::string& map) {
  constexpr std::string_view kFormat = "a .scen file";
  require_goals(instance, kFormat);
  require_no_tasks(instance, kFormat);
  require_default_agent_ids(instance, kFormat);
  if (map.find_first_of(" \t\r\n") != std::string::npos)
    throw InputError(path.string(), "",
                     fmt::format("the map's name '{}' has blanks in it; expected none, for they "
                                 "separate the columns of a .scen file",
                                 map));
  std::vector<ScenarioRow> rows;
  std::vector<Time> lengths;
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const auto [row, length] = row_of(instance, i, map);
    rows.push_back(row);
    lengths.push_back(length);
  }
  write_scenario(path, rows, lengths);
}

void write_instance(const std::filesystem::path& path, const Instance& instance,
                    const std::string& map, Outlives outlives) {
  OrderedJson agents = OrderedJson::array();
  for (const Agent& agent : instance.agents()) agents.push_back(agent_json(instance, agent));
  OrderedJson tasks = OrderedJson::array();
  for (const Task& task : instance.tasks()) tasks.push_back(task_json(instance, task));
  write_file_atomically(path, dump_by_lines({{"map", map}, {"agents", agents}, {"tasks", tasks}}),
                        outlives);
}

}  // namespace grove
