// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <iterator>
#include <string>

#include "proof/certificate.h"

namespace grove::detail {
namespace {

void add(const Grid& grid, std::string& text) {
  fmt::format_to(std::back_inserter(text), "grid {} {}\n", grid.width(), grid.height());
  for (Cell cell = 0; cell < grid.cell_count(); ++cell) {
    text += grid.passable(cell) ? '.' : '@';
    if ((cell + 1) % grid.width() == 0) text += '\n';
  }
}

void add(const Roadmap& roadmap, std::string& text) {
  fmt::format_to(std::back_inserter(text), "roadmap {} {}\n", roadmap.vertices().size(),
                 roadmap.roads().size());
  for (const Road& road : roadmap.roads())
    fmt::format_to(std::back_inserter(text), "{} {} {} {}\n", road.from, road.to, road.steps,
                   road.one_way ? 1 : 0);
}

void add(const Instance& instance, const Agent& agent, std::string& text) {
  const Pose start = instance.pose_of(agent.start);
  const Time turn = agent.motion.turn_steps;
  fmt::format_to(std::back_inserter(text), "agent {} {} {}\n", start.place,
                 agent.goal.value_or(kNoPlace), turn);
  if (turn > 0)
    fmt::format_to(std::back_inserter(text), "looks {} {} {} {}\n", letter(start.heading),
                   letter(start.to), start.steps,
                   agent.goal_heading ? letter(*agent.goal_heading) : '-');
  if (!agent.goals.empty())
    fmt::format_to(std::back_inserter(text), "goals {}\n", fmt::join(agent.goals, " "));
  if (!instance.world().is_working(agent.start)) return;
  const Work& work = instance.world().work(agent.start);
  fmt::format_to(std::back_inserter(text), "working {} {}\n", work.task, work.done);
}

void add(const Task& task, std::string& text) {
  fmt::format_to(std::back_inserter(text), "task {} {} {}\n", task.cell, task.duration,
                 fmt::join(task.agents, " "));
  if (!task.needs_all()) fmt::format_to(std::back_inserter(text), "need {}\n", task.need);
}

}  // namespace

std::uint64_t certificate_checksum(const Instance& instance) {
  std::string text;
  std::visit([&](const auto& map) { add(map, text); }, instance.map());
  for (const Agent& agent : instance.agents()) add(instance, agent, text);
  for (const Task& task : instance.tasks()) add(task, text);
  std::uint64_t hash = 0xCBF29CE484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3;
  return hash;
}

}  // namespace grove::detail
