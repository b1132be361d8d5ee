// SPDX-License-Identifier: MIT
#include "tests/fuzz/tiny_instance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace grove::detail::fuzz {
namespace {

Grid grid_of(const std::vector<std::string>& rows) {
  if (rows.empty()) throw std::invalid_argument("a map needs a row");
  std::vector<bool> passable;
  for (const std::string& row : rows) {
    if (row.size() != rows[0].size()) throw std::invalid_argument("map rows differ in length");
    for (char c : row) passable.push_back(c == '.');
  }
  return Grid(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), passable);
}

std::string vertex_id(Position p) {
  return fmt::format("{},{}", p.x, p.y);
}

Roadmap roadmap_of(const TinyInstance& tiny) {
  const std::vector<Position> cells = passable_cells(tiny.rows);
  std::vector<Vertex> vertices;
  for (const Position p : cells)
    vertices.push_back({vertex_id(p), {static_cast<double>(p.x), static_cast<double>(p.y)}});
  const auto vertex = [&](Position p) {
    return static_cast<int>(std::ranges::find(cells, p) - cells.begin());
  };
  std::vector<Road> roads;
  for (const TinyInstance::Road& road : tiny.roads)
    roads.push_back({vertex(road.from), vertex(road.to), road.steps, road.one_way});
  return Roadmap(std::move(vertices), std::move(roads));
}

Place vertex_at(const Roadmap& roadmap, Position p) {
  const auto vertex = roadmap.vertex(vertex_id(p));
  if (!vertex) throw std::invalid_argument("not a vertex");
  return roadmap.place_of_vertex(*vertex);
}

Place place_of(const InstanceBuilder& builder, Position p) {
  if (const Roadmap* roadmap = builder.roadmap()) return vertex_at(*roadmap, p);
  const auto& grid = std::get<Grid>(builder.map());
  if (!grid.contains(p)) throw std::invalid_argument("outside the map");
  return grid.cell(p);
}

Place start_of(const InstanceBuilder& builder, const TinyInstance::Agent& agent) {
  if (agent.road < 0) return place_of(builder, agent.start);
  const auto& roads = builder.roadmap()->roads();
  if (agent.road >= std::ssize(roads) || agent.along < 1 || agent.along >= roads[agent.road].steps)
    throw std::invalid_argument("not on a road");
  return builder.roadmap()->place_on_road(agent.road, agent.along);
}

AgentSpec spec_of(const InstanceBuilder& builder, int number, const TinyInstance::Agent& agent) {
  AgentSpec spec{.id = fmt::format("a{}", number),
                 .start = {.place = start_of(builder, agent)},
                 .goal = {},
                 .motion = {agent.turn_steps}};
  if (agent.goal) spec.goal = place_of(builder, *agent.goal);
  if (agent.turn_steps > 0) {
    spec.start.heading = agent.heading;
    spec.start.to = agent.turned > 0 ? agent.to : agent.heading;
    spec.start.steps = agent.turned;
    spec.goal_heading = agent.goal_heading;
  }
  if (agent.work >= 0) spec.working = WorkBegun{fmt::format("t{}", agent.work), agent.done};
  return spec;
}

// Reads `x,y` from the stream.
Position read_position(std::istream& in) {
  Position p;
  char comma = 0;
  if (!(in >> p.x >> comma >> p.y) || comma != ',') throw std::invalid_argument("expected x,y");
  return p;
}

Heading read_heading(std::istream& in) {
  std::string text;
  in >> text;
  const auto heading = heading_of(text);
  if (!heading) throw std::invalid_argument("expected a heading");
  return *heading;
}

int read_number(std::istream& in) {
  int number = 0;
  if (!(in >> number)) throw std::invalid_argument("expected a number");
  return number;
}

void read_more(std::istream& in, TinyInstance::Agent& agent) {
  for (std::string word; in >> word;) {
    if (word == "turn") {
      agent.turn_steps = read_number(in);
      agent.heading = read_heading(in);
    } else if (word == "to") {
      agent.to = read_heading(in);
      agent.turned = read_number(in);
    } else if (word == "end") {
      agent.goal_heading = read_heading(in);
    } else if (word == "work") {
      agent.work = read_number(in);
      agent.done = read_number(in);
    } else if (word == "road") {
      agent.road = read_number(in);
      agent.along = read_number(in);
    } else {
      throw std::invalid_argument(fmt::format("did not expect '{}'", word));
    }
  }
  in.clear();
}

TinyInstance::Agent read_agent(std::istream& in) {
  TinyInstance::Agent agent{.start = read_position(in), .goal = {}};
  std::string arrow;
  if (!(in >> arrow) || arrow != "->") throw std::invalid_argument("expected start -> goal");
  in >> std::ws;
  if (in.peek() == '-')
    in.get();
  else
    agent.goal = read_position(in);
  read_more(in, agent);
  return agent;
}

TinyInstance::Task read_task(std::istream& in) {
  TinyInstance::Task task{read_position(in), {}};
  in >> std::ws;
  if (in.peek() == 't') {
    std::string takes;
    in >> takes;
    task.duration = read_number(in);
  }
  char colon = 0;
  if (!(in >> colon) || colon != ':') throw std::invalid_argument("expected cell: agents");
  for (int agent = 0; in >> agent;) task.agents.push_back(agent);
  in.clear();
  return task;
}

TinyInstance::Road read_road(std::istream& in) {
  TinyInstance::Road road;
  road.from = read_position(in);
  char sign = 0;
  in >> sign;
  if (sign != '=' && sign != '>') throw std::invalid_argument("expected = or >");
  road.one_way = sign == '>';
  road.to = read_position(in);
  if (!(in >> road.steps)) throw std::invalid_argument("expected steps");
  return road;
}

std::string read_row(std::istream& in) {
  std::string row;
  in >> row;
  if (row.find_first_not_of(".@") != std::string::npos)
    throw std::invalid_argument("expected a map row of '.' and '@'");
  return row;
}

void read_line(const std::string& line, std::string& section, TinyInstance& instance) {
  if (line == "map" || line == "roads" || line == "agents" || line == "tasks") {
    section = line;
    return;
  }
  if (line == "no following") {
    instance.may_follow = false;
    return;
  }
  std::istringstream in(line);
  if (section == "map")
    instance.rows.push_back(read_row(in));
  else if (section == "roads")
    instance.roads.push_back(read_road(in));
  else if (section == "agents")
    instance.agents.push_back(read_agent(in));
  else if (section == "tasks")
    instance.tasks.push_back(read_task(in));
  else
    throw std::invalid_argument("expected 'map', 'roads', 'agents' or 'tasks'");
  std::string rest;
  if (in >> rest) throw std::invalid_argument(fmt::format("did not expect '{}'", rest));
}

}  // namespace

std::vector<Position> passable_cells(const std::vector<std::string>& rows) {
  std::vector<Position> cells;
  for (int y = 0; y < static_cast<int>(rows.size()); ++y)
    for (int x = 0; x < static_cast<int>(rows[y].size()); ++x)
      if (rows[y][x] == '.') cells.push_back({x, y});
  return cells;
}

Instance TinyInstance::build() const {
  InstanceBuilder builder(roads.empty() ? Map(grid_of(rows)) : Map(roadmap_of(*this)));
  if (!may_follow) builder.forbid_following();
  for (std::size_t a = 0; a < agents.size(); ++a)
    builder.add_agent(spec_of(builder, static_cast<int>(a), agents[a]));
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    std::vector<std::string> ids;
    for (int agent : tasks[t].agents) ids.push_back(fmt::format("a{}", agent));
    const Place place = place_of(builder, tasks[t].cell);
    if (const auto* grid = std::get_if<Grid>(&builder.map()); grid && !grid->passable(place))
      throw std::invalid_argument("a task on a blocked cell");
    builder.add_task(fmt::format("t{}", t), place, ids, tasks[t].duration);
  }
  return std::move(builder).build();
}

std::string TinyInstance::to_text() const {
  std::string text = fmt::format("map\n{}\n", fmt::join(rows, "\n"));
  if (!roads.empty()) text += "roads\n";
  for (const Road& road : roads)
    text += fmt::format("{},{} {} {},{} {}\n", road.from.x, road.from.y, road.one_way ? '>' : '=',
                        road.to.x, road.to.y, road.steps);
  text += "agents\n";
  for (const Agent& agent : agents) {
    text += fmt::format("{},{} -> ", agent.start.x, agent.start.y);
    text += agent.goal ? fmt::format("{},{}", agent.goal->x, agent.goal->y) : "-";
    if (agent.turn_steps > 0)
      text += fmt::format(" turn {} {}", agent.turn_steps, letter(agent.heading));
    if (agent.turned > 0) text += fmt::format(" to {} {}", letter(agent.to), agent.turned);
    if (agent.goal_heading) text += fmt::format(" end {}", letter(*agent.goal_heading));
    if (agent.work >= 0) text += fmt::format(" work {} {}", agent.work, agent.done);
    if (agent.road >= 0) text += fmt::format(" road {} {}", agent.road, agent.along);
    text += '\n';
  }
  if (!tasks.empty()) text += "tasks\n";
  for (const Task& task : tasks)
    text += fmt::format("{},{}{}: {}\n", task.cell.x, task.cell.y,
                        task.duration > 0 ? fmt::format(" takes {}", task.duration) : "",
                        fmt::join(task.agents, " "));
  if (!may_follow) text += "no following\n";
  return text;
}

TinyInstance TinyInstance::parse(std::string_view text) {
  TinyInstance instance;
  std::istringstream in{std::string(text)};
  std::string section;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    line.erase(std::min(line.find('#'), line.size()));
    while (!line.empty() && line.back() == ' ') line.pop_back();
    if (line.empty()) continue;
    try {
      read_line(line, section, instance);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("line {}: {}", number, error.what()));
    }
  }
  return instance;
}

bool in_use(const TinyInstance& instance, Position p) {
  return std::ranges::any_of(instance.agents,
                             [&](const auto& a) { return a.start == p || a.goal == p; }) ||
         std::ranges::any_of(instance.tasks, [&](const auto& t) { return t.cell == p; });
}

}  // namespace grove::detail::fuzz
