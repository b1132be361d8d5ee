// SPDX-License-Identifier: MIT
#include "tests/fuzz/tiny_instance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace grove::fuzz {
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

Instance build_on_roads(const TinyInstance& tiny) {
  InstanceBuilder builder(roadmap_of(tiny));
  const Roadmap& roadmap = *builder.roadmap();
  for (std::size_t a = 0; a < tiny.agents.size(); ++a) {
    const TinyInstance::Agent& agent = tiny.agents[a];
    const auto goal = agent.goal ? std::optional(vertex_at(roadmap, *agent.goal)) : std::nullopt;
    builder.add_agent(fmt::format("a{}", a), vertex_at(roadmap, agent.start), goal);
  }
  for (std::size_t t = 0; t < tiny.tasks.size(); ++t) {
    std::vector<std::string> ids;
    for (int agent : tiny.tasks[t].agents) ids.push_back(fmt::format("a{}", agent));
    builder.add_task(fmt::format("t{}", t), vertex_at(roadmap, tiny.tasks[t].cell), ids);
  }
  return std::move(builder).build();
}

// Reads `x,y`, leaving the stream behind it.
Position read_position(std::istream& in) {
  Position p;
  char comma = 0;
  if (!(in >> p.x >> comma >> p.y) || comma != ',') throw std::invalid_argument("expected x,y");
  return p;
}

TinyInstance::Agent read_agent(std::istream& in) {
  TinyInstance::Agent agent{read_position(in), std::nullopt};
  std::string arrow;
  if (!(in >> arrow) || arrow != "->") throw std::invalid_argument("expected start -> goal");
  in >> std::ws;
  if (in.peek() == '-') {
    in.get();
    return agent;
  }
  agent.goal = read_position(in);
  return agent;
}

TinyInstance::Task read_task(std::istream& in) {
  TinyInstance::Task task{read_position(in), {}};
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
  if (!roads.empty()) return build_on_roads(*this);
  InstanceBuilder builder(grid_of(rows));
  for (std::size_t a = 0; a < agents.size(); ++a)
    builder.add_agent(fmt::format("a{}", a), agents[a].start, agents[a].goal);
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    std::vector<std::string> ids;
    for (int agent : tasks[t].agents) ids.push_back(fmt::format("a{}", agent));
    builder.add_task(fmt::format("t{}", t), tasks[t].cell, ids);
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
    text += agent.goal ? fmt::format("{},{}\n", agent.goal->x, agent.goal->y) : "-\n";
  }
  if (!tasks.empty()) text += "tasks\n";
  for (const Task& task : tasks)
    text += fmt::format("{},{}: {}\n", task.cell.x, task.cell.y, fmt::join(task.agents, " "));
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

}  // namespace grove::fuzz
