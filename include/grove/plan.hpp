// SPDX-License-Identifier: MIT
/// \file
/// What a solve ends with: a status, perhaps a plan, always a bound; and whether that is true.
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

/// A robot at work on a task.
struct Work {
  std::string task = {};  ///< Its id.
  int begin = 0;          ///< The step at which it begins; below 0 if the robot starts at work.
  int end = 0;            ///< The step at which it is done.
};

/// What one robot does.
struct AgentPlan {
  std::string id = {};                  ///< The agent's.
  int cost = 0;                         ///< The step from which on it rests, with everything done.
  std::vector<Pose> path = {};          ///< At times 0, 1, ..., cost; it stays in the last one.
  std::vector<std::string> tasks = {};  ///< Ids, in the order in which they are completed.
  std::vector<Work> work = {};          ///< On tasks with a duration.
};

/// What all robots do.
struct Plan {
  std::int64_t cost = 0;               ///< The sum of the robots', in steps.
  std::vector<AgentPlan> agents = {};  ///< In the instance's order.

  /// Where robot `agent`, counted from 0, is at `time` >= 0; it rests where its path, which must
  /// not be empty, ends. Throws std::out_of_range for a robot that there is not.
  const Pose& pose(std::size_t agent, int time) const {
    const std::vector<Pose>& path = agents.at(agent).path;
    const auto t = static_cast<std::size_t>(time);
    return t < path.size() ? path[t] : path.back();
  }
  /// The step from which on everybody rests.
  int makespan() const {
    int most = 0;
    for (const AgentPlan& agent : agents) most = agent.cost > most ? agent.cost : most;
    return most;
  }
};

/// What a solve has proven.
enum class Status : std::uint8_t {
  optimal,     ///< A plan, and none costs less.
  bounded,     ///< A plan that costs at most 1 + omega times the lower bound.
  feasible,    ///< A plan that may cost more than that.
  infeasible,  ///< Proven: there is no plan.
  unknown,     ///< No plan when a limit struck.
};

/// "optimal", "bounded" and so on, as plan files have it.
GROVE_API std::string_view to_string(Status status);

/// What a solve ends with.
struct Solution {
  Status status = Status::unknown;  ///< What is proven.
  std::optional<Plan> plan = {};    ///< With optimal, bounded and feasible.
  /// Proven: no plan costs less, whatever limit struck; meaningless where infeasible.
  std::int64_t lower_bound = 0;
  double omega = 0;  ///< That was asked for.
  /// What the search did, by the names of the plan file's `stats`: "nodes_expanded".
  std::map<std::string, std::int64_t> counts = {};
  std::map<std::string, double> measures = {};  ///< Likewise, real numbers: "wall_s".
  /// Likewise, words: "stopped_by", the limit that struck; "reason", why there is no plan.
  std::map<std::string, std::string> texts = {};
  /// False: everything claimed holds of plans in which no agent enters a place in the step in which
  /// another leaves it (Rules::following).
  bool following = true;

  /// (cost - lower bound) / lower bound: how much dearer than the best the plan is at most. None
  /// without a plan, or with a bound of 0 below a plan that costs something.
  GROVE_API std::optional<double> gap() const;
};

/// One thing that is wrong with a plan.
struct Violation {
  std::string json_pointer =
      {};                    ///< JSON Pointer (RFC 6901) into the plan file: "/agents/0/path/7".
  std::string message = {};  ///< One line for a person.
  std::string place = {};    ///< \deprecated Equal to json_pointer; removed in 0.2.
};

/// Everything that is wrong with a plan, at most `limit`: worked out by a checker that shares
/// nothing with the search. Empty: it is valid. Throws InvalidArgument for places and ids that do
/// not exist.
GROVE_API std::vector<Violation> check(const Instance& instance, const Plan& plan,
                                       std::size_t limit = 20);
/// With what is claimed of it: cost, bound and status.
GROVE_API std::vector<Violation> check(const Instance& instance, const Solution& solution,
                                       std::size_t limit = 20);

/// The plan in which robots walk these paths, in the instance's order: where each is at times 0, 1,
/// ... Costs, and in which order tasks are done, are worked out; whether it is valid is not. Throws
/// InvalidArgument for places that do not exist, and where robots turn or tasks take time, for
/// there places do not say what a robot does.
GROVE_API Plan plan_from_paths(const Instance& instance,
                               const std::vector<std::vector<Place>>& paths);

/// Reads a plan file, of this instance; believes what it says: check() does not. Throws InputError.
GROVE_API Solution read_plan(const std::filesystem::path& path, const Instance& instance);
/// The same of the text of such a file.
GROVE_API Solution parse_plan(std::string_view text, const Instance& instance);
/// Writes a plan file, whole or not at all. Throws InputError if it cannot be written, and
/// InvalidArgument for a plan that check() refuses.
GROVE_API void write_plan(const std::filesystem::path& path, const Instance& instance,
                          const Solution& solution);
/// The text that write_plan() writes. Throws InvalidArgument for a plan that check() refuses.
GROVE_API std::string plan_text(const Instance& instance, const Solution& solution);

}  // namespace grove
