// SPDX-License-Identifier: MIT
#include "io/instance_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "io/agents_entry.h"
#include "io/atomic_file.h"
#include "io/format_support.h"
#include "io/input_error.h"
#include "io/json_text.h"
#include "io/json_value.h"
#include "io/known_keys.h"
#include "io/map_file.h"
#include "io/path_entry.h"
#include "io/roadmap_file.h"
#include "io/scenario_file.h"
#include "io/state_memory.h"
#include "io/text_file.h"
#include "model/assert.h"
#include "model/distance_field.h"

namespace grove::detail {
namespace {

using OrderedJson = nlohmann::ordered_json;

// Calls add(). Converts an InstanceError to an InputError with its position below `value` in the
// file.
template <typename Add>
void at_place_of(const JsonValue& value, Add add) {
  try {
    add();
  } catch (const InstanceError& error) {
    value.fail(error.what(), error.field());
  }
}

// Reads "motion" and the keys that depend on it. A key that has no effect for this motion is an
// error, because a user who writes it expects an effect on the plan.
Motion read_motion(const InstanceBuilder& builder, const JsonValue& agent) {
  const auto motion = agent.find("motion");
  if (!motion) {
    for (const char* key : {"heading", "goal_heading", "turn_steps"})
      if (const auto value = agent.find(key))
        value->fail_expected("no such key without \"motion\": \"turning\"");
    return {};
  }
  if (!motion->json().is_string() || motion->text() != "turning")
    motion->fail_expected("\"turning\", or no such key for an agent that turns freely");
  if (builder.roadmap())
    motion->fail("agents can turn only on grids; expected no such key on a roadmap");
  const auto steps = agent.find("turn_steps");
  return {steps ? static_cast<Time>(steps->integer(1, InstanceBuilder::kMaxDuration)) : 1};
}

// Reads a start, which may be on a road or within a turn.
Pose read_start_pose(const InstanceBuilder& builder, Motion motion, const JsonValue& agent) {
  const JsonValue start = agent.member("start");
  if (builder.roadmap()) return {.place = read_start(*builder.roadmap(), start)};
  if (motion.turn_steps == 0) return read_pose(builder.map(), motion, start);
  const auto heading = agent.find("heading");
  if (start.json().is_array() && start.size() == 2) {
    Pose pose = read_pose(builder.map(), {}, start);
    pose.heading = pose.to = read_heading(heading ? *heading : agent.member("heading"));
    return pose;
  }
  const Pose pose = read_pose(builder.map(), motion, start);
  if (heading && read_heading(*heading) != pose.heading)
    heading->fail(fmt::format("the start has \"{}\"; expected the same, or no such key",
                              letter(pose.heading)));
  return pose;
}

// True for a list of cells, and for a list of ids of vertices.
bool is_list_of_places(const InstanceBuilder& builder, const nlohmann::json& json) {
  if (!json.is_array() || json.empty()) return false;
  if (json.front().is_array()) return true;
  return builder.roadmap() && json.size() > 1 &&
         std::ranges::all_of(json, [](const auto& each) { return each.is_string(); });
}

std::optional<Place> read_goal(const InstanceBuilder& builder, const JsonValue& agent) {
  const auto goal = agent.find("goal");
  if (!goal) return std::nullopt;
  if (is_list_of_places(builder, goal->json()))
    goal->fail("found a list of places; expected one place, or the key 'goals' for a choice");
  if (builder.roadmap()) return read_vertex(*builder.roadmap(), *goal);
  return read_pose(builder.map(), {}, *goal).place;
}

// An empty list would leave an agent without a place to rest, which no user means.
std::vector<Place> read_goals(const InstanceBuilder& builder, const JsonValue& agent) {
  std::vector<Place> places;
  const auto goals = agent.find("goals");
  if (!goals) return places;
  if (!goals->json().is_array()) goals->fail_expected("a list of at least one place");
  if (goals->size() == 0)
    goals->fail("found an empty list; expected a list of at least one place, or no such key");
  if (!builder.roadmap() && goals->json().front().is_number())
    goals->fail("found one cell; expected a list of cells [x, y], or the key 'goal' for one cell");
  for (std::size_t k = 0; k < goals->size(); ++k) {
    const JsonValue goal = goals->element(k);
    places.push_back(builder.roadmap() ? read_vertex(*builder.roadmap(), goal)
                                       : read_pose(builder.map(), {}, goal).place);
  }
  return places;
}

std::optional<WorkBegun> read_working(const JsonValue& agent) {
  const auto working = agent.find("working");
  if (!working) return std::nullopt;
  if (!working->json().is_object()) working->fail_expected("{\"task\": ID, \"done\": STEPS}");
  return WorkBegun{
      working->member("task").text(),
      static_cast<Time>(working->member("done").integer(0, InstanceBuilder::kMaxDuration))};
}

void add_agent(InstanceBuilder& builder, const JsonValue& agent) {
  AgentSpec spec{.id = agent.member("id").text(), .start = {}, .goal = {}};
  spec.motion = read_motion(builder, agent);
  spec.start = read_start_pose(builder, spec.motion, agent);
  spec.goal = read_goal(builder, agent);
  spec.goals = read_goals(builder, agent);
  if (const auto heading = agent.find("goal_heading")) {
    spec.goal_heading = read_heading(*heading);
    if (!spec.goal && spec.goals.empty())
      heading->fail("the agent has no goal; expected a goal, or no such key");
  }
  spec.working = read_working(agent);
  at_place_of(agent, [&] { builder.add_agent(std::move(spec)); });
}

Time read_duration(const JsonValue& task) {
  const auto duration = task.find("duration");
  return duration ? static_cast<Time>(duration->integer(0, InstanceBuilder::kMaxDuration)) : 0;
}

void add_task(InstanceBuilder& builder, const JsonValue& task) {
  const std::string id = task.member("id").text();
  const JsonValue cell = task.member("cell");
  const std::vector<std::string> agents = agents_of_task(task, [&] { return builder.agent_ids(); });
  const Time duration = read_duration(task);
  const std::optional<int> need = need_of_task(task, agents.size());
  if (builder.roadmap()) {
    const Place place = read_vertex(*builder.roadmap(), cell);
    at_place_of(task, [&] { builder.add_task(id, place, agents, duration, need); });
  } else {
    const Position position = cell.position();
    at_place_of(task, [&] { builder.add_task(id, position, agents, duration, need); });
  }
}

// Returns the estimate of the states that the instance will have.
StateMemory add_all(InstanceBuilder& builder, const JsonValue& root, const std::string& file,
                    const InputRules& rules) {
  StateMemory memory(builder);
  const JsonValue agents = root.member("agents");
  if (agents.size() == 0) agents.fail("expected at least one agent");
  const JsonValue tasks = root.member("tasks");
  for (std::size_t i = 0; i < agents.size(); ++i) {
    memory.add_agent(read_motion(builder, agents.element(i)));
    add_agent(builder, agents.element(i));
  }
  std::int64_t visitors = 0;  // in the lists for which "*" stands
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const JsonValue task = tasks.element(i);
    memory.add_task(read_duration(task));
    if (is_for_all_agents(task)) {
      visitors += static_cast<std::int64_t>(agents.size());
      require_memory(rules, file, task.path(), visitors, "agents of tasks", kBytesPerVisitor);
    }
    add_task(builder, task);
  }
  memory.require(root, file, rules);
  return memory;
}

Instance read_robots(InstanceBuilder builder, const JsonValue& root, const std::string& file,
                     const InputRules& rules = {}) {
  const StateMemory memory = add_all(builder, root, file, rules);
  std::optional<Instance> instance;
  at_place_of(root, [&] { instance = std::move(builder).build(); });
  GROVE_CHECK(instance->world().state_count() <= memory.states(),
              "the memory required is that of all states");
  GROVE_CHECK(instance->agents().size() == root.member("agents").size() &&
                  instance->tasks().size() == root.member("tasks").size(),
              "the instance has the agents and tasks of its file");
  return *std::move(instance);
}

// Returns the path of a file that an instance names relative to its own folder.
std::filesystem::path file_named_by(const JsonValue& value, const std::filesystem::path& folder,
                                    std::string_view what, const InputRules& rules) {
  if (value.text().empty()) value.fail_expected(fmt::format("the name of {} file", what));
  std::filesystem::path path;
  try {
    path = file_in_folder(rules, folder, value.text());
  } catch (const std::invalid_argument& error) {
    value.fail(error.what());
  }
  if (!std::filesystem::is_regular_file(path))
    value.fail(
        fmt::format("{} '{}'; expected {}, relative to {}",
                    std::filesystem::is_directory(path) ? "found the folder" : "there is no file",
                    path.string(), what, folder == "." ? "the current folder" : "this file"));
  return path;
}

// Returns the first character of the file that is not blank; NUL if there is none. It distinguishes
// maps from roadmaps.
char first_character(const std::filesystem::path& path) {
  char first = 0;
  std::ifstream(path) >> first;
  return first;
}

// Throws InputError if "map" names a file that begins with '{', or "roadmap" names a .map file that
// does not. `path` must be a result of file_named_by(), which checks that the instance may name
// this file. The message never contains file content.
void require_map_not_roadmap(const JsonValue& value, const std::filesystem::path& path,
                             bool is_roadmap) {
  const bool is_json = first_character(path) == '{';
  if (is_json && !is_roadmap)
    value.fail(
        fmt::format("'{}' is a JSON file; expected a map, or this file under the key "
                    "\"roadmap\" if it is a roadmap",
                    path.string()));
  if (!is_json && is_roadmap && path.extension() == ".map")
    value.fail(
        fmt::format("'{}' has the suffix of a map; expected a roadmap, or this file under the "
                    "key \"map\"",
                    path.string()));
}

void add_row(InstanceBuilder& builder, const std::string& file, const ScenarioRow& row,
             const std::string& id) {
  try {
    builder.add_agent(id, row.start, row.goal);
  } catch (const InstanceError& error) {
    throw InputError(file, fmt::format("line {}, {}", row.line, error.field()), error.what());
  }
}

// Returns the scenario row of agent `i`, and the distance from its start to its destination.
std::pair<ScenarioRow, Time> row_of(const Instance& instance, AgentIndex i,
                                    const std::string& map) {
  const Grid& grid = instance.grid();
  const Agent& agent = instance.agent(i);
  const Time length = distance_field(grid, *agent.goal)[agent.start];
  if (length >= kNever)
    throw NotRepresentable(fmt::format("agents/{}", i),
                           fmt::format("agent '{}' cannot reach its goal; expected a path, because "
                                       "a .scen file has its length",
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

// Returns the path entry of a start, destination or task; a vertex is written as its id only.
OrderedJson place_json(const Map& map, Motion motion, const Pose& pose) {
  OrderedJson json = pose_json(map, motion, pose);
  return json.size() == 1 ? OrderedJson(json[0]) : json;
}

OrderedJson agent_json(const Instance& instance, const Agent& agent) {
  const Map& map = instance.map();
  const Pose start = instance.pose_of(agent.start);
  const bool turns = agent.motion.turn_steps > 0;
  OrderedJson json{{"id", agent.id},
                   {"start", place_json(map, start.steps > 0 ? agent.motion : Motion(), start)}};
  if (agent.goal) json["goal"] = place_json(map, {}, {.place = *agent.goal});
  if (!agent.goals.empty()) {
    OrderedJson& goals = json["goals"] = OrderedJson::array();
    for (const Place goal : agent.goals) goals.push_back(place_json(map, {}, {.place = goal}));
  }
  if (turns) json["motion"] = "turning";
  if (agent.motion.turn_steps > 1) json["turn_steps"] = agent.motion.turn_steps;
  if (turns) json["heading"] = std::string(1, letter(start.heading));
  if (agent.goal_heading) json["goal_heading"] = std::string(1, letter(*agent.goal_heading));
  if (instance.world().is_working(agent.start)) {
    const Work& work = instance.world().work(agent.start);
    json["working"] = {{"task", instance.task(work.task).id}, {"done", work.done}};
  }
  return json;
}

// Writes "*" only for a task with a choice of agents, because an explicit list is easier to edit.
OrderedJson agents_json(const Instance& instance, const Task& task) {
  if (!task.needs_all() && std::ssize(task.agents) == instance.agent_count()) return "*";
  OrderedJson ids = OrderedJson::array();
  for (AgentIndex agent : task.agents) ids.push_back(instance.agent(agent).id);
  return ids;
}

OrderedJson task_json(const Instance& instance, const Task& task) {
  OrderedJson json{{"id", task.id},
                   {"cell", place_json(instance.map(), {}, {.place = task.cell})},
                   {"agents", agents_json(instance, task)}};
  if (!task.needs_all()) json["need"] = task.need;
  if (task.duration > 0) json["duration"] = task.duration;
  return json;
}

}  // namespace

LoadedInstance read_instance(const std::filesystem::path& path, const InputRules& rules) {
  return parse_instance(read_text(path), path.string(), path.parent_path(), rules);
}

LoadedInstance parse_instance(std::string_view text, const std::string& name,
                              const std::filesystem::path& folder, const InputRules& rules) {
  const JsonDocument document(text, name);
  const JsonValue root = document.root();
  std::vector<std::string> warnings;
  require_known_keys(root, instance_keys());

  const auto roadmap = root.find("roadmap");
  if (roadmap && root.find("map"))
    root.fail("found both 'map' and 'roadmap'; expected one of them");
  if (!roadmap && !root.find("map"))
    root.fail("key 'map' is missing; expected it, or 'roadmap', in this object");
  std::filesystem::path map_path = roadmap
                                       ? file_named_by(*roadmap, folder, "a roadmap", rules)
                                       : file_named_by(root.member("map"), folder, "a map", rules);
  require_map_not_roadmap(roadmap ? *roadmap : root.member("map"), map_path, roadmap.has_value());
  Map map =
      roadmap ? Map(read_roadmap(map_path, rules)) : Map(read_map(map_path, &warnings, rules));
  Instance instance = read_robots(InstanceBuilder(std::move(map)), root, name, rules);
  return {std::move(instance), std::move(map_path), std::move(warnings),
          hints_on_need(root.member("tasks"), root.member("agents").size(), name)};
}

Instance parse_instance_on(InstanceBuilder builder, std::string_view text,
                           const std::string& name) {
  const JsonDocument document(text, name);
  const JsonValue root = document.root();
  require_known_keys(root, robot_keys());
  return read_robots(std::move(builder), root, name);
}

LoadedInstance read_scenario_instance(const std::filesystem::path& scenario,
                                      const std::filesystem::path& map, int agents,
                                      const InputRules& rules) {
  const std::string file = scenario.string();
  const std::vector<ScenarioRow> rows = read_scenario(scenario);
  if (agents < 1) throw InputError(file, "", "expected at least one agent");
  if (rows.size() < static_cast<std::size_t>(agents))
    throw InputError(
        file, "",
        fmt::format("has {} rows; expected at least {}, one per agent", rows.size(), agents));
  std::vector<std::string> warnings;
  const Grid grid = read_map(map, &warnings, rules);
  require_same_map(scenario, {rows.data(), static_cast<std::size_t>(agents)}, map, grid);
  InstanceBuilder builder(grid);
  for (int i = 0; i < agents; ++i) add_row(builder, file, rows[i], default_agent_id(i));
  return {std::move(builder).build(), map, std::move(warnings)};
}

void write_scenario_instance(const std::filesystem::path& path, const Instance& instance,
                             const std::string& map) {
  constexpr std::string_view kFormat = "a .scen file";
  require_free_grid(instance, kFormat);
  require_goals(instance, kFormat);
  require_no_tasks(instance, kFormat);
  require_default_agent_ids(instance, kFormat);
  if (map.find_first_of(" \t\r\n") != std::string::npos)
    throw InputError(path.string(), "",
                     fmt::format("the map's name '{}' contains blanks; expected none, because they "
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

std::string instance_text(const Instance& instance, const std::string& map) {
  OrderedJson agents = OrderedJson::array();
  for (const Agent& agent : instance.agents()) agents.push_back(agent_json(instance, agent));
  OrderedJson tasks = OrderedJson::array();
  for (const Task& task : instance.tasks()) tasks.push_back(task_json(instance, task));
  OrderedJson json;
  if (!map.empty()) json[instance.is_on_grid() ? "map" : "roadmap"] = map;
  json["agents"] = std::move(agents);
  json["tasks"] = std::move(tasks);
  return dump_by_lines(json);
}

void write_instance(const std::filesystem::path& path, const Instance& instance,
                    const std::string& map, Durability durability) {
  write_file_atomically(path, instance_text(instance, map), durability);
}

}  // namespace grove::detail
