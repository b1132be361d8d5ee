// SPDX-License-Identifier: MIT
#include "tools/view/drive_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>
#include <unordered_set>

#include "grove/detail/execution/visits.h"
#include "grove/detail/io/input_error.h"
#include "grove/detail/io/text_file.h"

namespace grove::detail {
namespace {

constexpr const char* kFormat = "grove drive 1";

void check_first_line(const std::filesystem::path& path, std::string_view line,
                      const Instance& instance) {
  const nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
  const bool is_drive = json.is_object() && json.value("format", nlohmann::json()) == kFormat &&
                        json.value("robots", nlohmann::json()).is_array();
  if (!is_drive)
    throw InputError(path.string(), "line 1",
                     fmt::format("expected the log of a drive, {{\"format\": \"{}\", ...}}, as "
                                 "'grove toio --log' and 'grove vda5050 --log' write it",
                                 kFormat));
  std::unordered_set<std::string> robots;
  for (const Agent& agent : instance.agents()) robots.insert(agent.id);
  for (std::size_t i = 0; i < json["robots"].size(); ++i)
    if (const nlohmann::json& robot = json["robots"][i];
        !robot.is_string() || !robots.contains(robot))
      throw InputError(path.string(), fmt::format("line 1: /robots/{}", i),
                       fmt::format("found {}; expected a robot of the instance", robot.dump()));
}

}  // namespace

std::string read_drive_log(const std::filesystem::path& path, const Instance& instance) {
  std::string text = read_text(path);
  text.resize(text.rfind('\n') + 1);  // npos + 1 is 0
  check_first_line(path, std::string_view(text).substr(0, text.find('\n')), instance);
  return text;
}

std::string order_data(const Instance& instance, const PassingOrder& order) {
  const std::vector<std::vector<TaskVisit>> all_visits = task_visits(instance, order);
  nlohmann::json robots = nlohmann::json::array();
  for (AgentIndex agent = 0; agent < order.agent_count(); ++agent) {
    const ActionIndex begin = order.begin_of(agent);
    nlohmann::json ends = nlohmann::json::array();
    nlohmann::json waits = nlohmann::json::array();
    for (ActionIndex i = begin; i < order.end_of(agent); ++i) {
      const Action& action = order.actions()[i];
      ends.push_back(action.begin + action.steps);
      if (const ActionIndex other = order.after(i); other != kNoAction) {
        const AgentIndex whose = order.actions()[other].agent;
        waits.push_back({i - begin, whose, other - order.begin_of(whose)});
      }
    }
    nlohmann::json visits = nlohmann::json::array();
    for (const TaskVisit& visit : all_visits[agent])
      visits.push_back({visit.action == kNoAction ? -1 : visit.action - begin, visit.task});
    robots.push_back(
        {{"ends", std::move(ends)}, {"waits", std::move(waits)}, {"visits", std::move(visits)}});
  }
  return nlohmann::json{{"robots", std::move(robots)}}.dump();
}

}  // namespace grove::detail
