// SPDX-License-Identifier: MIT
#include "io/mapfw_file.h"

#include <fmt/format.h>

#include "io/atomic_file.h"
#include "io/format_support.h"
#include "io/input_error.h"
#include "io/json_text.h"
#include "io/json_value.h"
#include "io/map_file.h"
#include "io/waypoints.h"

namespace grove::detail {
namespace {

using OrderedJson = nlohmann::ordered_json;

// --- reading ---

void require_size(const JsonValue& array, std::size_t expected, std::string_view what) {
  if (array.size() != expected)
    array.fail(
        fmt::format("has {} entries; expected {}, one per {}", array.size(), expected, what));
}

bool is_free(const JsonValue& value) {
  if (!value.json().is_number_integer())
    value.fail_expected("0 for a passable cell, another integer for a blocked one");
  return value.json() == 0;
}

Grid read_grid(const JsonValue& root) {
  const auto width = static_cast<int>(root.member("width").integer(1, kMaxMapCells));
  const auto height = static_cast<int>(root.member("height").integer(1, kMaxMapCells));
  const JsonValue grid = root.member("grid");
  require_size(grid, height, "row");
  std::vector<bool> passable;
  for (int y = 0; y < height; ++y) {
    const JsonValue row = grid.element(y);
    require_size(row, width, "column");
    if (passable.size() + static_cast<std::size_t>(width) > kMaxMapCells)
      row.fail(fmt::format("the map has too many cells; expected at most {}", kMaxMapCells));
    for (int x = 0; x < width; ++x) passable.push_back(is_free(row.element(x)));
  }
  return Grid(width, height, passable);
}

class ProblemReader {
 public:
  ProblemReader(const std::string& file, const JsonValue& root)
      : starts_(root.member("starts")),
        goals_(root.member("goals")),
        waypoints_(root.member("waypoints")),
        builder_(read_grid(root)),
        tasks_(file) {
    require_size(goals_, starts_.size(), "start");
    require_size(waypoints_, starts_.size(), "start");
  }

  Instance read() && {
    for (std::size_t i = 0; i < starts_.size(); ++i) add_agent(i);
    tasks_.add_to(builder_);
    try {
      return std::move(builder_).build();
    } catch (const InstanceError& error) {
      starts_.fail(error.what());
    }
  }

 private:
  void add_agent(std::size_t i) {
    const std::string id = default_agent_id(static_cast<AgentIndex>(i));
    const JsonValue start = starts_.element(i);
    const JsonValue goal = goals_.element(i);
    const Position from = start.position();
    const Position to = goal.position();
    try {
      builder_.add_agent(id, from, to);
    } catch (const InstanceError& error) {
      (error.field() == "goal" ? goal : start).fail(error.what());
    }
    const JsonValue cells = waypoints_.element(i);
    for (std::size_t k = 0; k < cells.size(); ++k)
      tasks_.add(id, cells.element(k).position(), cells.element(k).path());
  }

  JsonValue starts_;
  JsonValue goals_;
  JsonValue waypoints_;
  InstanceBuilder builder_;
  Waypoints tasks_;
};

// --- writing ---

OrderedJson cell_json(const Grid& grid, Cell cell) {
  const Position p = grid.position(cell);
  return {p.x, p.y};
}

OrderedJson grid_json(const Grid& grid) {
  OrderedJson rows = OrderedJson::array();
  for (int y = 0; y < grid.height(); ++y) {
    OrderedJson row = OrderedJson::array();
    for (int x = 0; x < grid.width(); ++x) row.push_back(grid.passable(grid.cell({x, y})) ? 0 : 1);
    rows.push_back(std::move(row));
  }
  return rows;
}

OrderedJson waypoints_json(const Instance& instance, const Agent& agent) {
  OrderedJson cells = OrderedJson::array();
  for (TaskIndex task : agent.tasks)
    cells.push_back(cell_json(instance.grid(), instance.task(task).cell));
  return cells;
}

}  // namespace

Instance read_mapfw_problem(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  const JsonDocument document(path);
  const JsonValue root = document.root();
  const std::string file = path.string();
  UnknownKeys unknown(file, warnings);
  unknown.look_at(root, {"grid", "width", "height", "starts", "goals", "waypoints"});
  return ProblemReader(file, root).read();
}

void write_mapfw_problem(const std::filesystem::path& path, const Instance& instance) {
  constexpr std::string_view kFormat = "MAPFW's JSON";
  require_free_grid(instance, kFormat);
  require_fixed_tasks(instance, kFormat);
  require_goals(instance, kFormat);
  require_default_agent_ids(instance, kFormat);
  require_distinct_cells(instance, kFormat);
  require_default_task_ids(instance, kFormat);
  const Grid& grid = instance.grid();
  OrderedJson starts = OrderedJson::array();
  OrderedJson goals = OrderedJson::array();
  OrderedJson waypoints = OrderedJson::array();
  for (const Agent& agent : instance.agents()) {
    starts.push_back(cell_json(grid, agent.start));
    goals.push_back(cell_json(grid, *agent.goal));
    waypoints.push_back(waypoints_json(instance, agent));
  }
  write_file_atomically(path, dump_by_lines({{"grid", grid_json(grid)},
                                             {"width", grid.width()},
                                             {"height", grid.height()},
                                             {"starts", starts},
                                             {"goals", goals},
                                             {"waypoints", waypoints}}));
}

}  // namespace grove::detail
