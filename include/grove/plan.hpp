// SPDX-License-Identifier: MIT
// What a solve ends with: a status, perhaps a plan, always a bound; and whether that is true.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grove/export.hpp"
#include "grove/instance.hpp"

namespace grove {

// At work on a task from `begin` to `end`, steps; begun before 0 if the robot starts at work.
struct Work {
  std::string task = {};
  int begin = 0;
  int end = 0;
};

struct AgentPlan {
  std::string id = {};
  int cost = 0;                         // the step from which on it rests, with everything done
  std::vector<Pose> path = {};          // at times 0, 1, ..., cost; it stays in the last one
  std::vector<std::string> tasks = {};  // in the order in which they are completed
  std::vector<Work> work = {};          // on tasks with a duration
};

struct Plan {
  std::int64_t cost = 0;               // the sum of the robots'
  std::vector<AgentPlan> agents = {};  // in the instance's order

  // Where robot `agent` is at `time` >= 0; it rests where its path ends.
  const Pose& pose(std::size_t agent, int time) const {
    const std::vector<Pose>& path = agents.at(agent).path;
    const auto t = static_cast<std::size_t>(time);
    return t < path.size() ? path[t] : path.back();
  }
  // The step from which on everybody rests.
  int makespan() const {
    int most = 0;
    for (const AgentPlan& agent : agents) most = agent.cost > most ? agent.cost : most;
    return most;
  }
};

enum class Status : std::uint8_t {
  optimal,     // a plan, and none costs less
  bounded,     // a plan that costs at most 1 + omega times the lower bound
  feasible,    // a plan that may cost more than that
  infeasible,  // proven: there is no plan
  unknown,     // no plan when a limit struck
};

GROVE_API std::string_view to_string(Status status);

struct Solution {
  Status status = Status::unknown;
  std::optional<Plan> plan = {};
  std::int64_t lower_bound = 0;  // proven: no plan costs less; meaningless where infeasible
  double omega = 0;              // that was asked for
  std::map<std::string, std::int64_t> counts = {};  // what the search did ("nodes_expanded")
  std::map<std::string, double> measures = {};      // ("wall_s", "gap")

  // (cost - lower bound) / lower bound: how much dearer than the best the plan is at most. None
  // without a plan, or with a bound of 0 below a plan that costs something.
  std::optional<double> gap() const;
};

// One thing that is wrong; `place` is a JSON path of the plan file.
struct Violation {
  std::string place = {};
  std::string message = {};
};

// Everything that is wrong with a plan, at most `limit`: worked out by a checker that shares
// nothing with the search. Empty: it is valid. Throws InvalidArgument for places and ids that do
// not exist.
GROVE_API std::vector<Violation> check(const Instance& instance, const Plan& plan,
                                       std::size_t limit = 20);
// With what is claimed of it: cost, bound and status.
GROVE_API std::vector<Violation> check(const Instance& instance, const Solution& solution,
                                       std::size_t limit = 20);

// The plan in which robots walk these paths, in the instance's order: where each is at times 0, 1,
// ... Costs, and in which order tasks are done, are worked out; whether it is valid is not. Throws
// InvalidArgument for places that do not exist, and where robots turn or tasks take time, for there
// places do not say what a robot does.
GROVE_API Plan plan_from_paths(const Instance& instance,
                               const std::vector<std::vector<Place>>& paths);

// Reads a plan file, of this instance; believes what it says. Throws InputError.
GROVE_API Solution read_plan(const std::filesystem::path& path, const Instance& instance);
GROVE_API Solution parse_plan(std::string_view text, const Instance& instance);
// Writes one, whole or not at all. Throws InputError.
GROVE_API void write_plan(const std::filesystem::path& path, const Instance& instance,
                          const Solution& solution);
GROVE_API std::string plan_text(const Instance& instance, const Solution& solution);

}  // namespace grove
