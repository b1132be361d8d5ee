// SPDX-License-Identifier: MIT
#include "tools/replan/change_arguments.h"

#include <fmt/format.h>

#include <CLI/Error.hpp>
#include <algorithm>

#include "io/input_error.h"
#include "model/parse_number.h"
#include "tools/common/options.h"
#include "tools/execute/robots.h"

namespace grove::detail {
namespace {

// The parts of an error's field; for "new_tasks/3/agents/0", "new_tasks", 3 and "/agents/0".
struct Field {
  explicit Field(const std::string& text) {
    const std::size_t slash = text.find('/');
    const std::size_t next = std::min(text.find('/', slash + 1), text.size());
    part = text.substr(0, slash);
    if (slash == std::string::npos) return;
    number = parse_number<std::size_t>(text.substr(slash + 1, next - slash - 1)).value_or(0);
    rest = text.substr(next);
  }
  std::string part;
  std::size_t number = 0;
  std::string rest;
};

}  // namespace

std::vector<Delay> late_robots(const ChangeArguments& arguments, const Instance& instance) {
  std::vector<Delay> late;
  for (const std::string& text : arguments.late) {
    const auto split = text.rfind('=');
    if (split == std::string::npos) refuse("--late", text, "ROBOT=STEPS");
    const AgentIndex robot = robot_of("--late", text, text.substr(0, split), instance);
    if (std::ranges::count(late, robot, &Delay::agent) > 0)
      refuse("--late", text, "each robot at most once");
    late.push_back(
        {robot, static_cast<Time>(parse_integer("--late", text.substr(split + 1), kPlanSteps))});
  }
  return late;
}

RequestedChange::RequestedChange(const ChangeArguments& arguments, const Instance& instance) {
  for (const std::string& file : arguments.new_tasks) read_new_tasks(file, instance);
  for (const std::string& task : arguments.dropped) {
    change_.dropped_tasks.push_back(task);
    dropped_.push_back({"--drop-task", task});
  }
  for (const std::string& text : arguments.blocked) block(text, instance);
}

void RequestedChange::read_new_tasks(const std::string& file, const Instance& instance) {
  std::vector<std::string> hints;
  for (ReadTask& read : grove::detail::read_new_tasks(file, instance, &hints)) {
    change_.new_tasks.push_back(std::move(read.task));
    new_tasks_.push_back({file, read.place});
  }
  hints_.insert(hints_.end(), hints.begin(), hints.end());
}

void RequestedChange::block(const std::string& text, const Instance& instance) {
  if (instance.roadmap()) return block_on_roadmap(text, *instance.roadmap());
  const Grid& grid = instance.grid();
  const std::size_t comma = text.find(',');
  const auto x = parse_number<int>(text.substr(0, comma), 0, grid.width() - 1);
  const auto y = comma == std::string::npos
                     ? std::nullopt
                     : parse_number<int>(text.substr(comma + 1), 0, grid.height() - 1);
  if (!x || !y)
    grove::detail::refuse("--blocked", text,
                          fmt::format("X,Y, a cell with x in 0..{} and y in 0..{}",
                                      grid.width() - 1, grid.height() - 1));
  change_.blocked.push_back(grid.cell({*x, *y}));
  blocked_.push_back({"--blocked", text});
}

void RequestedChange::block_on_roadmap(const std::string& text, const Roadmap& roadmap) {
  if (const auto vertex = roadmap.vertex(text)) {
    change_.blocked.push_back(roadmap.place_of_vertex(*vertex));
    blocked_.push_back({"--blocked", text});
    return;
  }
  // Ids can contain commas, so each comma is tried as the separator.
  for (std::size_t comma = text.find(','); comma != std::string::npos;
       comma = text.find(',', comma + 1)) {
    const auto from = roadmap.vertex(text.substr(0, comma));
    const auto to = roadmap.vertex(text.substr(comma + 1));
    if (!from || !to || roadmap.roads_between(*from, *to).empty()) continue;
    for (const int road : roadmap.roads_between(*from, *to)) {
      change_.closed_roads.push_back(road);
      closed_roads_.push_back({"--blocked", text});
    }
    return;
  }
  grove::detail::refuse("--blocked", text,
                        "a vertex of the roadmap, or A,B: two vertices joined by a road");
}

void RequestedChange::refuse(const InstanceError& error) const {
  const Field field(error.field());
  if (field.part == "new_tasks") {
    const Source& source = new_tasks_[field.number];
    throw InputError(source.where, source.what + field.rest, error.what());
  }
  const auto& all = field.part == "dropped_tasks" ? dropped_
                    : field.part == "blocked"     ? blocked_
                                                  : closed_roads_;
  if (field.number >= all.size()) throw error;
  const Source& source = all[field.number];
  throw CLI::ValidationError(source.where,
                             fmt::format("'{}': {}", one_line(source.what), error.what()));
}

}  // namespace grove::detail
