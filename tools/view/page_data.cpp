// SPDX-License-Identifier: MIT
#include "tools/view/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

namespace grove::detail {
namespace {

using Json = nlohmann::ordered_json;

// Run-length encoding of moves or turns, such as "12E.3N": for each run its length, if more than 1,
// and its letter. A jump has the form "@TARGET;".
class Steps {
 public:
  void add(char letter) {
    if (letter == letter_) {
      ++count_;
      return;
    }
    flush();
    letter_ = letter;
    count_ = 1;
  }
  void jump(const std::string& to) {
    flush();
    text_ += "@" + to + ";";
  }
  std::string text() {
    flush();
    return text_;
  }

 private:
  void flush() {
    if (count_ > 1) text_ += std::to_string(count_);
    if (count_ > 0) text_ += letter_;
    count_ = 0;
    letter_ = 0;
  }

  std::string text_;
  char letter_ = 0;
  int count_ = 0;
};

// --- the world ---

std::string free_cells(const Grid& grid) {
  std::string text;
  bool free = true;
  int count = 0;
  const auto end_run = [&] { text += fmt::format("{}{}", text.empty() ? "" : " ", count); };
  for (Cell cell = 0; cell < grid.cell_count(); ++cell) {
    if (grid.passable(cell) != free) {
      end_run();
      free = !free;
      count = 0;
    }
    ++count;
  }
  end_run();
  return text;
}

Json world_json(const Instance& instance) {
  if (const Roadmap* roadmap = instance.roadmap()) {
    Json vertices = Json::array();
    for (const Vertex& vertex : roadmap->vertices())
      vertices.push_back({vertex.id, vertex.at.x, vertex.at.y});
    Json roads = Json::array();
    for (const Road& road : roadmap->roads())
      roads.push_back({road.from, road.to, road.steps, road.one_way ? 1 : 0});
    return {{"kind", "roadmap"}, {"vertices", std::move(vertices)}, {"roads", std::move(roads)}};
  }
  const Grid& grid = instance.grid();
  return {{"kind", "grid"},
          {"width", grid.width()},
          {"height", grid.height()},
          {"free", free_cells(grid)}};
}

// --- agents and tasks ---

// Returns the angle in steps of a turn, clockwise from north.
Time angle(Motion motion, const Pose& pose) {
  const Time heading = static_cast<Time>(pose.heading) * motion.turn_steps;
  const bool leftward = pose.steps > 0 && pose.to == left_of(pose.heading);
  const Time around = 4 * motion.turn_steps;
  return (heading + (leftward ? around - pose.steps : pose.steps)) % around;
}

// Returns the angle as text: "3"; within a turn "3l" (to the left) or "3r" (to the right).
std::string angle_text(Motion motion, const Pose& pose) {
  std::string text = std::to_string(angle(motion, pose));
  if (pose.steps > 0) text += pose.to == left_of(pose.heading) ? 'l' : 'r';
  return text;
}

Json agent_json(const Instance& instance, AgentIndex index) {
  const Agent& agent = instance.agent(index);
  const Pose pose = instance.pose_of(agent.start);
  Json json{{"id", agent.id}, {"start", pose.place}};
  if (agent.goal) json["goal"] = *agent.goal;
  if (!agent.goals.empty()) json["goals"] = agent.goals;
  if (agent.motion.turn_steps > 0) {
    json["turn"] = agent.motion.turn_steps;
    json["angle"] = angle_text(agent.motion, pose);
    if (agent.goal_heading)
      json["goalAngle"] = static_cast<Time>(*agent.goal_heading) * agent.motion.turn_steps;
  }
  const World& world = instance.world();
  if (world.is_working(agent.start)) {
    const Work& work = world.work(agent.start);
    json["working"] = {work.task, work.done};
  }
  return json;
}

// Writes "*" for a task that any agent may visit, because there can be thousands of such tasks.
Json tasks_json(const Instance& instance) {
  Json json = Json::array();
  for (const Task& task : instance.tasks()) {
    const bool is_for_any = !task.needs_all() && std::ssize(task.agents) == instance.agent_count();
    json.push_back({{"id", task.id},
                    {"place", task.cell},
                    {"agents", is_for_any ? Json("*") : Json(task.agents)}});
    if (!task.needs_all()) json.back()["need"] = task.need;
    if (task.duration > 0) json.back()["duration"] = task.duration;
  }
  return json;
}

// --- plans ---

// Returns the letter of a move, or nullopt if it has none (README.md).
std::optional<char> move_letter(const Instance& instance, Place from, Place to) {
  if (from == to) return '.';
  if (!instance.is_on_grid())
    return to == from + 1 ? std::optional('+') : to == from - 1 ? std::optional('-') : std::nullopt;
  const Position a = instance.grid().position(from);
  const Position b = instance.grid().position(to);
  if (a.y == b.y && b.x == a.x + 1) return 'E';
  if (a.y == b.y && b.x == a.x - 1) return 'W';
  if (a.x == b.x && b.y == a.y + 1) return 'S';
  if (a.x == b.x && b.y == a.y - 1) return 'N';
  return std::nullopt;
}

// Returns '.' if the angle stays, 'r' or 'l' for one step of a turn, and nullopt for any other
// change.
std::optional<char> turn_letter(Motion motion, const Pose& from, const Pose& to) {
  if (from.heading == to.heading && from.to == to.to && from.steps == to.steps) return '.';
  const auto after = [&](Heading end) {
    Pose next{to.place, from.heading, end, from.steps + 1};
    if (next.steps == motion.turn_steps) next = {to.place, end, end, 0};
    return next;
  };
  if (from.steps == 0 || from.to == right_of(from.heading))
    if (to == after(right_of(from.heading))) return 'r';
  if (from.steps == 0 || from.to == left_of(from.heading))
    if (to == after(left_of(from.heading))) return 'l';
  return std::nullopt;
}

std::string path_text(const Instance& instance, const Path& path) {
  Steps steps;
  Place last = kNoPlace;
  for (std::size_t t = 0; t < path.size(); ++t) {
    const Place place = instance.world().place(path[t]);
    const auto letter = t > 0 ? move_letter(instance, last, place) : std::nullopt;
    if (letter)
      steps.add(*letter);
    else
      steps.jump(std::to_string(place));
    last = place;
  }
  return steps.text();
}

std::string turns_text(const Instance& instance, Motion motion, const Path& path) {
  Steps steps;
  Pose last;
  for (std::size_t t = 0; t < path.size(); ++t) {
    const Pose pose = instance.pose_of(path[t]);
    const auto letter = t > 0 ? turn_letter(motion, last, pose) : std::nullopt;
    if (letter)
      steps.add(*letter);
    else
      steps.jump(angle_text(motion, pose));
    last = pose;
  }
  return steps.text();
}

Json agent_plan_json(const Instance& instance, AgentIndex index, const AgentPlan& plan,
                     const ClaimedPlan& claimed) {
  const auto claims = [&](const char* what) {
    return std::ranges::count(claimed.unclaimed, what) == 0;
  };
  const Motion motion = instance.agent(index).motion;
  Json json = Json::object();
  if (claims("cost")) json["cost"] = plan.cost;
  json["path"] = path_text(instance, plan.path);
  if (motion.turn_steps > 0) json["turns"] = turns_text(instance, motion, plan.path);
  if (claims("order of tasks")) json["tasks"] = plan.sequence;
  if (!plan.work.empty()) {
    Json work = Json::array();
    for (const WorkTime& time : plan.work) work.push_back({time.task, time.begin, time.end});
    json["work"] = std::move(work);
  }
  return json;
}

Json plan_json(const Instance& instance, const NamedPlan& named) {
  const Solution& solution = named.claimed.solution;
  const auto claims = [&](const char* what) {
    return std::ranges::count(named.claimed.unclaimed, what) == 0;
  };
  Json json{{"name", named.name}, {"claims", Json::object()}};
  if (claims("lower bound")) {
    json["claims"]["status"] = to_string(solution.status);
    json["claims"]["lower_bound"] = solution.lower_bound;
    json["claims"]["omega"] = solution.omega.to_string();
  }
  if (!solution.plan) return json;
  if (claims("cost")) json["claims"]["cost"] = solution.plan->cost;
  Json agents = Json::array();
  for (std::size_t i = 0; i < solution.plan->agents.size(); ++i)
    agents.push_back(agent_plan_json(instance, static_cast<AgentIndex>(i), solution.plan->agents[i],
                                     named.claimed));
  json["agents"] = std::move(agents);
  return json;
}

// Escapes every '<', because each tag that could end or nest a <script> element starts with it.
std::string without_markup(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json)
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

}  // namespace

std::string page_data(const std::string& instance_name, const Instance& instance,
                      std::span<const NamedPlan> plans) {
  Json json{{"format", "grove view 1"}, {"instance", instance_name}};
  json["world"] = world_json(instance);
  json["agents"] = Json::array();
  for (AgentIndex i = 0; i < instance.agent_count(); ++i)
    json["agents"].push_back(agent_json(instance, i));
  json["tasks"] = tasks_json(instance);
  json["plans"] = Json::array();
  for (const NamedPlan& plan : plans) json["plans"].push_back(plan_json(instance, plan));
  return without_markup(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace grove::detail
