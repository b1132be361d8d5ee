// SPDX-License-Identifier: MIT
/// \file
/// Plans, solutions (status, plan, lower bound), and the checker.
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

/// Execution of a task by a robot.
struct Work {
  std::string task = {};  ///< Id of the task.
  int begin = 0;          ///< Time at which it begins; negative if it began before time 0.
  int end = 0;            ///< Time at which it is complete.
};

/// Plan of one robot.
struct AgentPlan {
  std::string id = {};                  ///< Id of the agent.
  int cost = 0;                         ///< Finish time: it rests from then on, all tasks done.
  std::vector<Pose> path = {};          ///< Poses at times 0, ..., cost; it stays in the last one.
  std::vector<std::string> tasks = {};  ///< Ids of its tasks in order of completion.
  std::vector<Work> work = {};          ///< Execution of its tasks with a duration.
};

/// Plan of all robots.
struct Plan {
  std::int64_t cost = 0;               ///< Sum of the robots' costs, in time steps.
  std::vector<AgentPlan> agents = {};  ///< In the order of the instance.

  /// Returns the pose of robot number `agent`, from 0, at `time` >= 0. After the end of its path,
  /// which must not be empty, it rests there. Throws std::out_of_range if there is no such robot.
  const Pose& pose(std::size_t agent, int time) const {
    const std::vector<Pose>& path = agents.at(agent).path;
    const auto t = static_cast<std::size_t>(time);
    return t < path.size() ? path[t] : path.back();
  }
  /// Time from which all robots rest.
  int makespan() const {
    int most = 0;
    for (const AgentPlan& agent : agents) most = agent.cost > most ? agent.cost : most;
    return most;
  }
};

/// What a run has proven.
enum class Status : std::uint8_t {
  optimal,     ///< The plan has minimum cost.
  bounded,     ///< The plan costs at most 1 + omega times the lower bound.
  feasible,    ///< The plan is valid; it may cost more than that.
  infeasible,  ///< There is no plan.
  unknown,     ///< A limit was reached before there was a plan.
};

/// Returns "optimal", "bounded", ...: the text of plan files.
GROVE_API std::string_view to_string(Status status);

/// Result of a run.
struct Solution {
  Status status = Status::unknown;  ///< What the run has proven.
  std::optional<Plan> plan = {};    ///< If the status is optimal, bounded or feasible.
  /// Proven: no plan costs less. Also valid after a limit was reached. Meaningless if infeasible.
  std::int64_t lower_bound = 0;
  double omega = 0;  ///< The requested tolerance.
  /// Counters of the search, with the names of `stats` in plan files: "nodes_expanded".
  std::map<std::string, std::int64_t> counts = {};
  std::map<std::string, double> measures = {};  ///< The same, real numbers: "wall_s".
  /// The same, texts: "stopped_by", the limit that ended the run; "reason", why there is no plan.
  std::map<std::string, std::string> texts = {};
  /// False: plan and bound are for the rule that no agent enters a place in the time step in which
  /// another agent leaves it (Rules::following).
  bool following = true;

  /// Returns (cost - lower bound) / lower bound: the plan costs at most this part more than an
  /// optimal plan. Returns 0 if cost and bound are both 0. Returns std::nullopt without a plan, or
  /// if the bound is 0 and the cost is not.
  GROVE_API std::optional<double> gap() const;
};

/// An error in a plan.
struct Violation {
  /// JSON Pointer (RFC 6901) into the plan file: "/agents/0/path/7".
  std::string json_pointer = {};
  std::string message = {};  ///< One line of text for people.
  std::string place = {};    ///< \deprecated Equal to json_pointer; removed in 0.2.
};

/// Returns the errors of a plan, at most `limit`; empty: the plan is valid. The checker recomputes
/// everything from instance and plan; it shares with the search only the representation of worlds
/// and poses. Throws InvalidArgument for places and ids that do not exist.
GROVE_API std::vector<Violation> check(const Instance& instance, const Plan& plan,
                                       std::size_t limit = 20);
/// The same, with the claims of the solution: cost, bound and status.
GROVE_API std::vector<Violation> check(const Instance& instance, const Solution& solution,
                                       std::size_t limit = 20);

/// Returns the plan with the given paths, in the order of the instance: the places of each robot at
/// times 0, 1, ... Computes costs and orders of tasks; does not check the plan. Throws
/// InvalidArgument for places that do not exist, and for instances with turning robots or task
/// durations, because there the places do not determine the actions.
GROVE_API Plan plan_from_paths(const Instance& instance,
                               const std::vector<std::vector<Place>>& paths);

/// Reads a plan file of this instance. The claims of the file are not verified; use check(). Throws
/// InputError.
GROVE_API Solution read_plan(const std::filesystem::path& path, const Instance& instance);
/// The same for the text of such a file.
GROVE_API Solution parse_plan(std::string_view text, const Instance& instance);
/// Writes a plan file, completely or not at all. Throws InputError if it cannot be written, and
/// InvalidArgument if check() finds an error.
GROVE_API void write_plan(const std::filesystem::path& path, const Instance& instance,
                          const Solution& solution);
/// Returns the text that write_plan() writes. Throws InvalidArgument if check() finds an error.
GROVE_API std::string plan_text(const Instance& instance, const Solution& solution);

}  // namespace grove
