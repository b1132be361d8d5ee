// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "io/atomic_file.h"
#include "io/csv.h"
#include "io/plan_export.h"
#include "io/plan_steps.h"
#include "io/yaml_text.h"
#include "model/assert.h"

namespace grove::detail {
namespace {

struct Waypoint {
  double seconds = 0;
  Point at;
  double theta = 0;  // radians
  std::string task;
};

double angle(Heading heading) {
  constexpr double kRight = std::numbers::pi / 2;
  switch (heading) {
    case Heading::kNorth:
      return kRight;
    case Heading::kEast:
      return 0;
    case Heading::kSouth:
      return -kRight;
    case Heading::kWest:
      break;
  }
  return std::numbers::pi;
}

double angle(const Pose& pose, Time turn_steps) {
  const double from = angle(pose.heading);
  if (pose.steps == 0) return from;
  const double turned = std::remainder(angle(pose.to) - from, 2 * std::numbers::pi);
  return std::remainder(from + turned * pose.steps / turn_steps, 2 * std::numbers::pi);
}

class WaypointsOf {
 public:
  WaypointsOf(const Instance& instance, AgentIndex agent, const AgentPlan& plan, const Scale& scale)
      : instance_(instance), agent_(agent), plan_(plan), scale_(scale) {}

  std::vector<Waypoint> list() const {
    const std::vector<std::string> tasks = tasks_by_time();
    std::vector<Waypoint> waypoints;
    for (Time t = 0; t <= end(); ++t) {
      const auto changes = [&](Time before, Time after) {
        return before < 0 || after > end() || state(before) != state(after) ||
               tasks[before] != tasks[after];
      };
      if (changes(t - 1, t) || changes(t, t + 1))
        waypoints.push_back({t * scale_.seconds_per_step, at(t), theta(t), tasks[t]});
    }
    return waypoints;
  }

 private:
  Time end() const { return plan_.cost; }
  State state(Time t) const { return state_at(plan_.path, t); }
  Point at(Time t) const {
    return metres(instance_.map(), scale_.frame, instance_.world().place(state(t)));
  }
  // By time: the id of the task that the robot visits or executes; "" if there is none.
  std::vector<std::string> tasks_by_time() const {
    std::vector<std::string> tasks(static_cast<std::size_t>(end()) + 1);
    const std::vector<Time> visits = visit_times(instance_, plan_);
    GROVE_CHECK(std::ranges::is_sorted(visits) && (visits.empty() || visits.back() <= end()),
                "a robot visits its tasks in order, before it finishes");
    for (std::size_t i = 0; i < visits.size(); ++i)
      tasks[visits[i]] = instance_.task(plan_.sequence[i]).id;
    for (const WorkTime& work : plan_.work)
      for (Time t = std::max(work.begin, 0); t <= work.end; ++t)
        tasks[t] = instance_.task(work.task).id;
    return tasks;
  }

  double theta(Time t) const {
    const Agent& agent = instance_.agent(agent_);
    if (agent.motion.turn_steps > 0)
      return angle(instance_.pose_of(state(t)), agent.motion.turn_steps);
    for (Time next = t + 1; next <= end(); ++next)
      if (state(next) != state(t)) return direction(at(t), at(next));
    for (Time before = t - 1; before >= 0; --before)
      if (state(before) != state(t)) return direction(at(before), at(t));
    return 0;
  }
  static double direction(const Point& from, const Point& to) {
    return std::atan2(to.y - from.y, to.x - from.x);
  }

  const Instance& instance_;
  const AgentIndex agent_;
  const AgentPlan& plan_;
  const Scale& scale_;
};

void add_pose(std::string& text, const Waypoint& w) {
  const double whole = std::floor(w.seconds);
  fmt::format_to(std::back_inserter(text),
                 "    - header: {{stamp: {{sec: {}, nanosec: {}}}, frame_id: map}}\n"
                 "      pose:\n"
                 "        position: {{x: {:.4f}, y: {:.4f}, z: 0.0}}\n"
                 "        orientation: {{x: 0.0, y: 0.0, z: {:.9f}, w: {:.9f}}}\n",
                 static_cast<std::int64_t>(whole),
                 static_cast<std::int64_t>(std::min(999'999'999.0, (w.seconds - whole) * 1e9)),
                 w.at.x, w.at.y, std::sin(w.theta / 2), std::cos(w.theta / 2));
}

}  // namespace

void write_waypoints(const std::filesystem::path& path, const Instance& instance,
                     const Solution& solution, const Scale& scale) {
  std::string text = "robot,seconds,x,y,theta,task\n";
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    const std::string id = csv_cell(instance.agent(agent).id);
    for (const Waypoint& w :
         WaypointsOf(instance, agent, solution.plan->agents[agent], scale).list())
      fmt::format_to(std::back_inserter(text), "{},{:.6g},{:.6g},{:.6g},{:.6f},{}\n", id, w.seconds,
                     w.at.x, w.at.y, w.theta, csv_cell(w.task));
  }
  write_file_atomically(path, text);
}

void write_nav_paths(const std::filesystem::path& path, const Instance& instance,
                     const Solution& solution, const Scale& scale) {
  std::string text =
      "# One nav_msgs/Path for each robot. Stamps are relative to the start of the plan.\n";
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    text +=
        fmt::format("{}:\n  header: {{stamp: {{sec: 0, nanosec: 0}}, frame_id: map}}\n  poses:\n",
                    yaml_text(instance.agent(agent).id));
    for (const Waypoint& w :
         WaypointsOf(instance, agent, solution.plan->agents[agent], scale).list())
      add_pose(text, w);
  }
  write_file_atomically(path, text);
}

}  // namespace grove::detail
