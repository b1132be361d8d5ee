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

std::string read_row(std::istream& in) {
  std::string row;
  in >> row;
  if (row.find_first_not_of(".@") != std::string::npos)
    throw std::invalid_argument("expected a map row of '.' and '@'");
  return row;
}

void read_line(const std::string& line, std::string& section, TinyInstance& instance) {
  if (line == "map" || line == "agents" || line == "tasks") {
    section = line;
    return;
  }
  std::istringstream in(line);
  if (section == "map")
    instance.rows.push_back(read_row(in));
  else if (section == "agents")
    instance.agents.push_back(read_agent(in));
  else if (section == "tasks")
    instance.tasks.push_back(read_task(in));
  else
    throw std::invalid_argument("expected 'map', 'agents' or 'tasks'");
  std::string rest;
  if (in >> rest) throw std::invalid_argument(fmt::format("did not expect '{}'", rest));
}

}  // namespace

Instance TinyInstance::build() const {
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
  std::string text = fmt::format("map\n{}\nagents\n", fmt::join(rows, "\n"));
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
