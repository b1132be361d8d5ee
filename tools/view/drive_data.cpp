// SPDX-License-Identifier: MIT
#include "tools/view/drive_data.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>

#include "execution/action_dependency_graph.h"

namespace grove::detail {
namespace {

constexpr double kFine = 1000;  // units per second, cell or metre: the resolution of drive logs

std::int64_t in_parts(double number) {
  return std::llround(number * kFine);
}

// Returns whole degrees from 0 to 359, or -1 if the angle is unknown (NaN).
std::int64_t degrees(double angle) {
  return std::isnan(angle) ? -1 : (std::llround(std::fmod(angle, 360)) + 360) % 360;
}

// Appends `"name":[1,0,-3]`: the value of `of` for each sample. Each value except the first is
// stored as its difference from the previous one.
template <typename Of>
void append_differences(std::string& text, const char* name, std::span<const PoseSample> seen,
                        Of of) {
  fmt::format_to(std::back_inserter(text), "\"{}\":[", name);
  std::int64_t before = 0;
  for (const PoseSample& sighting : seen) {
    const std::int64_t now = of(sighting);
    fmt::format_to(std::back_inserter(text), "{}{}", &sighting == seen.data() ? "" : ",",
                   now - before);
    before = now;
  }
  text += ']';
}

void append_robot(std::string& text, std::span<const PoseSample> seen) {
  const auto column = [&](const char* name, auto of) { append_differences(text, name, seen, of); };
  text += '{';
  column("t", [](const PoseSample& s) { return in_parts(s.seconds); });
  text += ',';
  column("x", [](const PoseSample& s) { return in_parts(s.x); });
  text += ',';
  column("y", [](const PoseSample& s) { return in_parts(s.y); });
  text += ',';
  column("angle", [](const PoseSample& s) { return degrees(s.angle); });
  text += ',';
  column("action", [](const PoseSample& s) { return std::int64_t{s.completed}; });
  text += ',';
  column("state", [](const PoseSample& s) { return std::int64_t{s.state}; });
  text += '}';
}

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::string drive_data(const ExecutionLog& log) {
  std::string text =
      fmt::format("{{\"order\":{},\"seconds_per_step\":{},\"states\":{},\"robots\":[",
                  quoted(log.order), log.seconds_per_step, nlohmann::json(kDriveStates).dump());
  for (const std::vector<PoseSample>& seen : log.robots) {
    if (&seen != log.robots.data()) text += ',';
    append_robot(text, seen);
  }
  return text + "]}";
}

std::string order_data(const Instance& instance, const ActionDependencyGraph& order) {
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
