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

/// A visit that the plan states: the execution of a task with a duration, or the visit to a task
/// that only some of its agents must visit (Task::need).
struct Work {
  std::string task = {};  ///< Id of the task.
  int begin = 0;          ///< Start time; negative if the execution started before time 0.
  int end = 0;            ///< Time of completion: `begin` + duration of the task.
};

/// Plan of one agent.
struct AgentPlan {
  std::string id = {};          ///< Id of the agent.
  int cost = 0;                 ///< Finish time: it rests from then on, with all tasks done.
  std::vector<Pose> path = {};  ///< Poses at times 0, ..., cost (cost + 1 entries).
  /// Ids of the tasks that it must visit and of those that it visits by choice, in an order of
  /// completion.
  std::vector<std::string> tasks = {};
  std::vector<Work> work = {};  ///< The visits that the plan states.
};

/// Plan of all agents.
struct Plan {
  std::int64_t cost = 0;               ///< Sum of the agents' costs, in time steps.
  std::vector<AgentPlan> agents = {};  ///< In the order of the instance.

  /// Returns the pose of agents[agent] at `time` >= 0; after the end of its path, the last pose.
  /// The path must not be empty. Throws std::out_of_range if `agent` >= agents.size().
  const Pose& pose(std::size_t agent, int time) const {
    const std::vector<Pose>& path = agents.at(agent).path;
    const auto t = static_cast<std::size_t>(time);
    return t < path.size() ? path[t] : path.back();
  }
  /// Returns the earliest time from which all agents rest: the maximum of their costs.
  int makespan() const {
    int most = 0;
    for (const AgentPlan& agent : agents) most = agent.cost > most ? agent.cost : most;
    return most;
  }
};

/// Outcome of a run: what it has proven about its plan and the instance.
enum class Status : std::uint8_t {
  optimal,     ///< The plan has minimum cost.
  bounded,     ///< The plan costs at most (1 + omega) times the lower bound.
  feasible,    ///< The plan is valid, but the bound does not prove that it is within omega.
  infeasible,  ///< Proven: no plan exists.
  unknown,     ///< No plan was found, usually because a limit was reached; plans may exist.
};

/// Returns the name of the status in plan files: "optimal", "bounded", ...
GROVE_API std::string_view to_string(Status status);

/// Result of a run.
struct Solution {
  Status status = Status::unknown;  ///< What the run has proven.
  std::optional<Plan> plan = {};    ///< Set if the status is optimal, bounded or feasible.
  /// Proven: no plan costs less, in time steps. Also valid after a limit was reached. Meaningless
  /// if the status is infeasible.
  std::int64_t lower_bound = 0;
  double omega = 0;  ///< The requested tolerance.
  /// Integer statistics of the search, by their names in `stats` of plan files: "nodes_expanded".
  std::map<std::string, std::int64_t> counts = {};
  std::map<std::string, double> measures = {};  ///< Real-valued statistics: "wall_s".
  /// Textual statistics: "stopped_by", the limit that ended the run; "reason", why no plan exists.
  std::map<std::string, std::string> texts = {};
  /// Rules::following of the run. False: the plan has no following conflict, and the bound holds
  /// only for plans without following conflicts.
  bool following = true;

  /// Returns (cost - lower bound) / lower bound, or 0 if both are 0. The plan costs at most (1 +
  /// gap) times the cost of an optimal plan. Returns std::nullopt if there is no plan, or if the
  /// lower bound is 0 and the cost is above 0.
  GROVE_API std::optional<double> gap() const;
};

/// An error in a plan or in the claims of a solution.
struct Violation {
  /// JSON Pointer (RFC 6901) into the plan file: "/agents/0/path/7".
  std::string json_pointer = {};
  std::string message = {};  ///< One-line message for people.
  std::string place = {};    ///< \deprecated Equal to json_pointer; will be removed in 0.2.
};

/// Returns the errors in a plan, at most `limit`; empty: the plan is valid. The checker recomputes
/// everything from instance and plan. It shares with the search only the representation of worlds
/// and poses. Throws InvalidArgument if the plan does not list the agents of the instance in their
/// order, or contains a pose or a task that does not exist in the instance.
GROVE_API std::vector<Violation> check(const Instance& instance, const Plan& plan,
                                       std::size_t limit = 20);
/// Returns the errors in the plan and in the claims of a solution (status, cost and lower bound,
/// against each other and omega), at most `limit`. It cannot verify the lower bound itself. Throws
/// InvalidArgument like the overload above, and for an invalid omega.
GROVE_API std::vector<Violation> check(const Instance& instance, const Solution& solution,
                                       std::size_t limit = 20);

/// Returns the plan with the given paths. `paths` has one path per agent, in the order of the
/// instance: its places at times 0, 1, ... Computes the costs and the order of the tasks, but does
/// not check the plan. Throws InvalidArgument if the number of paths is wrong, for places that do
/// not exist, and for instances with turning agents, or with tasks that take time or that only some
/// of their agents must visit, because their plans are not determined by places alone.
GROVE_API Plan plan_from_paths(const Instance& instance,
                               const std::vector<std::vector<Place>>& paths);
/// Returns the plan with the given paths and stated visits. `work` has one list per agent, in the
/// order of the instance. Like the overload above, but tasks may take time, and only some of their
/// agents may have to visit them. Also throws InvalidArgument for tasks that do not exist.
GROVE_API Plan plan_from_paths(const Instance& instance,
                               const std::vector<std::vector<Place>>& paths,
                               const std::vector<std::vector<Work>>& work);

/// An instance without choices (Instance::has_choices()), and a plan of it.
struct FixedChoices {
  Instance instance;  ///< Each agent must visit all its tasks, and has one destination or none.
  Plan plan;          ///< A valid plan of `instance`.
};

/// Fixes the choices of an instance as `plan` makes them, for the parts of Grove that do not
/// support choices. In the result each agent must visit its required tasks and those of which
/// `plan` states a visit, and the goal on which it rests is its destination. An agent without a
/// destination keeps none if it rests on the place of one of these tasks, or has no task; otherwise
/// its last place becomes its destination. The paths and the cost stay the same, except that an
/// agent costs less if `plan` states a visit of it, to a task without duration, after it has come
/// to rest. Throws InvalidArgument if the plan is not valid, with field() "/agents" if the last
/// place of such an agent is within a road, and with field() "/tasks/<i>/agents/<k>" if an agent
/// visits more than 64 tasks.
GROVE_API FixedChoices fix_choices(const Instance& instance, const Plan& plan);

/// Reads a plan file for `instance`. Does not verify the plan or its claims; for that, use check().
/// Throws InputError.
GROVE_API Solution read_plan(const std::filesystem::path& path, const Instance& instance);
/// Parses the text of a plan file like read_plan(). Throws InputError.
GROVE_API Solution parse_plan(std::string_view text, const Instance& instance);
/// Writes a plan file, completely or not at all. Throws InputError if the file cannot be written,
/// and InvalidArgument if check() finds an error or throws InvalidArgument.
GROVE_API void write_plan(const std::filesystem::path& path, const Instance& instance,
                          const Solution& solution);
/// Returns the content of the file that write_plan() writes. Throws InvalidArgument like
/// write_plan().
GROVE_API std::string plan_text(const Instance& instance, const Solution& solution);

}  // namespace grove
