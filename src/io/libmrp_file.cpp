// SPDX-License-Identifier: MIT
#include "io/libmrp_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <optional>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <variant>
#include <vector>

#include "io/atomic_file.h"
#include "io/format_support.h"
#include "io/input_error.h"
#include "io/map_file.h"
#include "io/waypoints.h"
#include "io/yaml_text.h"
#include "io/yaml_value.h"

namespace grove::detail {
namespace {

constexpr std::string_view kLibmrp = "libMultiRobotPlanning's YAML";

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

// The map file of ITA-CBS that `map` names, relative to the instance file `file`.
Grid read_named_grid(const YamlValue& map, const std::string& file,
                     std::vector<std::string>* warnings, const InputRules& rules) {
  namespace fs = std::filesystem;
  if (map.text().empty()) map.fail_expected("a map, or the name of a map file");
  fs::path path;
  try {
    path = file_in_folder(rules, fs::path(file).parent_path(), map.text());
  } catch (const std::invalid_argument& error) {
    map.fail(error.what());
  }
  if (!fs::is_regular_file(path))
    map.fail(
        fmt::format("there is no file '{}'; expected a map, relative to this file", path.string()));
  return read_map(path, warnings, rules);
}

// Reads the agents into a builder.
class AgentReader {
 public:
  // `by_rows`: whether cells are [row, column].
  AgentReader(InstanceBuilder& builder, Waypoints& waypoints, bool by_rows)
      : builder_(builder),
        grid_(std::get<Grid>(builder.map())),
        waypoints_(waypoints),
        by_rows_(by_rows) {}

  void add(const YamlValue& agent) {
    AgentSpec spec{.id = agent.member("name").text(), .start = {}, .goal = std::nullopt};
    spec.start.place = cell(agent.member("start"));
    const std::vector<YamlValue> destinations = this->destinations(agent);
    if (destinations.size() == 1) spec.goal = cell(destinations.front());
    if (destinations.size() > 1)
      for (const YamlValue& value : destinations) spec.goals.push_back(cell(value));
    try {
      builder_.add_agent(std::move(spec));
    } catch (const InstanceError& error) {
      place_of(agent, destinations, error.field()).fail(error.what());
    }
    add_waypoints(agent);
  }

 private:
  Position position(const YamlValue& value) const {
    const Position p = value.position();
    return by_rows_ ? Position{p.y, p.x} : p;
  }

  // Messages name cells as the file does.
  Cell cell(const YamlValue& value) const {
    const Position p = position(value);
    const Position in_file = value.position();
    if (!grid_.contains(p))
      value.fail(fmt::format("cell [{}, {}] is outside the map; expected {}", in_file.x, in_file.y,
                             cells_text()));
    if (!grid_.passable(grid_.cell(p)))
      value.fail(fmt::format("cell [{}, {}] is blocked on the map; expected a passable cell",
                             in_file.x, in_file.y));
    return grid_.cell(p);
  }

  std::string cells_text() const {
    const int columns = grid_.width() - 1;
    const int rows = grid_.height() - 1;
    return by_rows_
               ? fmt::format("[row, column] with row in 0..{} and column in 0..{}", rows, columns)
               : fmt::format("[x, y] (column, row) with x in 0..{} and y in 0..{}", columns, rows);
  }

  // The distinct cells of which `agent` chooses its destination; empty for an agent without one.
  std::vector<YamlValue> destinations(const YamlValue& agent) const {
    const auto goal = agent.find("goal");
    const auto choice = agent.find("potentialGoals");
    if (goal.has_value() + choice.has_value() + agent.find("goals").has_value() != 1)
      agent.fail("expected exactly one of the keys 'goal', 'goals' and 'potentialGoals'");
    std::vector<YamlValue> found;
    if (goal) found.push_back(*goal);
    std::unordered_set<Cell> cells;
    for (std::size_t k = 0; choice && k < choice->size(); ++k) {
      const YamlValue value = choice->element(k);
      if (cells.insert(cell(value)).second) found.push_back(value);
    }
    return found;
  }

  // The value in `agent` to which the field of an InstanceError refers.
  static YamlValue place_of(const YamlValue& agent, const std::vector<YamlValue>& destinations,
                            const std::string& field) {
    constexpr std::string_view kGoals = "goals/";
    if (field == "id") return agent.member("name");
    if (field == "start") return agent.member("start");
    if (field == "goal") return destinations.front();
    return field.starts_with(kGoals) ? destinations.at(std::stoul(field.substr(kGoals.size())))
                                     : agent;
  }

  void add_waypoints(const YamlValue& agent) {
    const auto goals = agent.find("goals");
    if (!goals) return;
    if (goals->size() == 0) goals->fail("there are no goals; expected at least one");
    for (std::size_t k = 0; k < goals->size(); ++k) {
      const YamlValue value = goals->element(k);
      waypoints_.add(agent.member("name").text(), position(value), value.place());
    }
  }

  InstanceBuilder& builder_;
  const Grid& grid_;
  Waypoints& waypoints_;
  bool by_rows_;
};

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
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    if (!instance.agent(i).goals.empty())
      throw not_representable(choice_of_goals(instance, i), format);
    if (instance.agent(i).has_destination())
      throw NotRepresentable(
          fmt::format("agents/{}", i),
          fmt::format(
              "agent '{}' has a goal to end on, which cannot be represented in {}; expected an "
              "agent that may end on any of its tasks (MG-MAPF)",
              instance.agent(i).id, format),
          Loss::kNothing);
  }
}

void require_no_choice_of_goals(const Instance& instance) {
  for (AgentIndex i = 0; i < instance.agent_count(); ++i)
    if (!instance.agent(i).goals.empty())
      throw not_representable(choice_of_goals(instance, i), "libMultiRobotPlanning's YAML for CBS",
                              "the format potential-goals (CBS-TA)");
}

std::string potential_goals_text(const Grid& grid, const Agent& agent) {
  std::string text = "    potentialGoals:";
  if (!agent.has_destination()) return text + " []\n";
  text += '\n';
  for (const Place goal : agent.destinations())
    fmt::format_to(std::back_inserter(text), "      - {}\n", cell_text(grid, goal));
  return text;
}

}  // namespace

Instance read_libmrp_instance(const std::filesystem::path& path, std::vector<std::string>* warnings,
                              const InputRules& rules) {
  const YamlDocument document(path, rules);
  const std::string file = path.string();
  const YamlValue root = document.root();
  if (const auto roadmap = root.find("roadmap"))
    roadmap->fail("found a roadmap; expected a grid, given by the key 'map'");
  UnknownYamlKeys unknown(file, warnings);
  unknown.look_at(root, {"map", "agents"});
  const YamlValue map = root.member("map");
  const bool is_named = map.node().IsScalar();
  InstanceBuilder builder(is_named ? read_named_grid(map, file, warnings, rules)
                                   : read_grid(map, file, rules));
  if (!is_named) unknown.look_at(map, {"dimensions", "obstacles"});
  const YamlValue agents = root.member("agents");
  Waypoints waypoints(file);
  AgentReader reader(builder, waypoints, is_named);
  for (std::size_t i = 0; i < agents.size(); ++i) {
    reader.add(agents.element(i));
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
  require_free_grid(instance, kLibmrp);
  require_no_choice_of_goals(instance);
  require_goals(instance, kLibmrp);
  require_no_tasks(instance, kLibmrp);
  std::string text = map_text(instance.grid()) + "agents:\n";
  for (const Agent& agent : instance.agents())
    text += head_text(instance.grid(), agent) +
            fmt::format("    goal: {}\n", cell_text(instance.grid(), *agent.goal));
  write_file_atomically(path, text);
}

void write_potential_goals(const std::filesystem::path& path, const Instance& instance) {
  require_free_grid(instance, kLibmrp);
  require_no_tasks(instance, kLibmrp);
  std::string text = map_text(instance.grid()) + "agents:\n";
  for (const Agent& agent : instance.agents())
    text += head_text(instance.grid(), agent) + potential_goals_text(instance.grid(), agent);
  write_file_atomically(path, text);
}

void write_mgcbs_instance(const std::filesystem::path& path, const Instance& instance) {
  constexpr std::string_view kFormat = "MGCBS's YAML";
  require_free_grid(instance, kFormat);
  require_fixed_tasks(instance, kFormat);
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
