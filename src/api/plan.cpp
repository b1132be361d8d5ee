// SPDX-License-Identifier: MIT
#include "grove/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "api/access.h"
#include "assignment/assignment.h"
#include "io/plan_file.h"
#include "io/plan_import.h"
#include "model/assert.h"
#include "model/check.h"

namespace grove {
namespace {

detail::TaskIndex task_of(const std::unordered_map<std::string, detail::TaskIndex>& tasks,
                          const std::string& id, const std::string& field) {
  const auto found = tasks.find(id);
  if (found == tasks.end()) throw InvalidArgument(field, fmt::format("there is no task '{}'", id));
  return found->second;
}

std::unordered_map<std::string, detail::TaskIndex> tasks_by_id(const detail::Instance& instance) {
  std::unordered_map<std::string, detail::TaskIndex> tasks;
  for (detail::TaskIndex i = 0; i < instance.task_count(); ++i)
    tasks.emplace(instance.task(i).id, i);
  return tasks;
}

std::vector<Violation> to_public(const std::vector<detail::Violation>& violations) {
  std::vector<Violation> all;
  for (const detail::Violation& v : violations)
    all.push_back({v.json_pointer, v.message, v.json_pointer});
  return all;
}

}  // namespace

std::string_view to_string(Status status) {
  return detail::to_string(static_cast<detail::Status>(status));
}

std::optional<double> Solution::gap() const {
  if (!plan) return std::nullopt;
  if (lower_bound > 0)
    return static_cast<double>(plan->cost - lower_bound) / static_cast<double>(lower_bound);
  return plan->cost == 0 ? std::optional<double>(0) : std::nullopt;
}

detail::Omega omega_of(double omega) {
  try {
    return std::isinf(omega) && omega > 0 ? detail::Omega::infinite()
                                          : detail::Omega::from_double(omega);
  } catch (const std::invalid_argument& error) {
    throw InvalidArgument("/omega", error.what());
  }
}

detail::Plan plan_of(const detail::Instance& instance, const Plan& plan) {
  const auto tasks = tasks_by_id(instance);
  if (static_cast<int>(plan.agents.size()) != instance.agent_count())
    throw InvalidArgument("/agents", fmt::format("{} paths; expected {}", plan.agents.size(),
                                                 instance.agent_count()));
  detail::Plan made{.cost = plan.cost, .agents = {}};
  for (detail::AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const AgentPlan& agent = plan.agents[i];
    const std::string field = fmt::format("/agents/{}", i);
    if (agent.id != instance.agent(i).id)
      throw InvalidArgument(
          field + "/id", fmt::format("found '{}'; expected '{}'", agent.id, instance.agent(i).id));
    detail::AgentPlan& own = made.agents.emplace_back();
    own.cost = agent.cost;
    for (const Pose& pose : agent.path) {
      const std::string place = fmt::format("{}/path/{}", field, own.path.size());
      own.path.push_back(
          instance.state_of(i, pose_of(instance.map(), instance.agent(i).motion, pose, place)));
    }
    for (const std::string& task : agent.tasks)
      own.sequence.push_back(task_of(tasks, task, field + "/tasks"));
    for (const Work& work : agent.work)
      own.work.push_back({task_of(tasks, work.task, field + "/work"), work.begin, work.end});
  }
  GROVE_CHECK(std::ssize(made.agents) == instance.agent_count(),
              "a converted plan has a path of each agent");
  return made;
}

detail::Plan valid_plan_of(const detail::Instance& instance, const Plan& plan,
                           const std::string& field) {
  detail::Solution solution;
  solution.plan = plan_of(instance, plan);
  solution.status = detail::status_of(plan.cost, 0, solution.omega);
  const auto wrong = detail::check(instance, solution, 1);
  if (!wrong.empty())
    throw InvalidArgument(field + wrong.front().json_pointer, wrong.front().message);
  return *std::move(solution.plan);
}

Plan public_plan(const detail::Instance& instance, const detail::Plan& plan) {
  GROVE_CHECK(std::ssize(plan.agents) == instance.agent_count(),
              "a plan has a path of each agent of its instance");
  Plan to_public{.cost = plan.cost, .agents = {}};
  for (detail::AgentIndex i = 0; i < static_cast<int>(plan.agents.size()); ++i) {
    const detail::AgentPlan& own = plan.agents[i];
    AgentPlan& agent = to_public.agents.emplace_back();
    agent.id = instance.agent(i).id;
    agent.cost = own.cost;
    for (const detail::State state : own.path)
      agent.path.push_back(
          public_pose(instance.map(), instance.agent(i).motion, instance.pose_of(state)));
    for (const detail::TaskIndex task : own.sequence) agent.tasks.push_back(instance.task(task).id);
    for (const detail::WorkTime& work : own.work)
      agent.work.push_back({instance.task(work.task).id, work.begin, work.end});
    GROVE_CHECK(agent.path.size() == own.path.size() && agent.tasks.size() == own.sequence.size() &&
                    agent.work.size() == own.work.size(),
                "the public path of an agent has all its poses and tasks");
  }
  return to_public;
}

detail::Solution solution_of(const detail::Instance& instance, const Solution& solution) {
  detail::Solution made;
  made.status = static_cast<detail::Status>(solution.status);
  if (solution.plan) made.plan = plan_of(instance, *solution.plan);
  made.lower_bound = solution.lower_bound;
  made.omega = omega_of(solution.omega);
  made.may_follow = solution.following;
  made.stats.counts = solution.counts;
  made.stats.measures = solution.measures;
  made.stats.texts = solution.texts;
  return made;
}

Solution public_solution(const detail::Instance& instance, const detail::Solution& solution) {
  Solution to_public;
  to_public.status = static_cast<Status>(solution.status);
  if (solution.plan) to_public.plan = public_plan(instance, *solution.plan);
  to_public.lower_bound = solution.lower_bound;
  to_public.omega = solution.omega.is_infinite() ? std::numeric_limits<double>::infinity()
                                                 : solution.omega.value();
  to_public.following = instance.may_follow() && solution.may_follow;
  to_public.counts = solution.stats.counts;
  to_public.measures = solution.stats.measures;
  to_public.texts = solution.stats.texts;
  GROVE_CHECK(to_string(to_public.status) == detail::to_string(solution.status),
              "the public status is the same as the internal one");
  return to_public;
}

std::vector<Violation> check(const Instance& instance, const Plan& plan, std::size_t limit) {
  Solution solution{.status = plan.cost == 0 ? Status::optimal : Status::feasible, .plan = plan};
  return check(instance, solution, limit);
}

std::vector<Violation> check(const Instance& instance, const Solution& solution,
                             std::size_t limit) {
  return with_public_exceptions([&] {
    const detail::Instance& inner = Access::instance(instance);
    return to_public(detail::check(inner, solution_of(inner, solution), limit));
  });
}

namespace {

std::vector<detail::Path> paths_of(const detail::Instance& inner,
                                   const std::vector<std::vector<Place>>& paths) {
  if (!detail::paths_are_places(inner))
    throw InvalidArgument("/agents", "found robots that turn; expected none");
  if (static_cast<int>(paths.size()) != inner.agent_count())
    throw InvalidArgument("/agents",
                          fmt::format("{} paths; expected {}", paths.size(), inner.agent_count()));
  std::vector<detail::Path> made;
  for (const std::vector<Place>& path : paths) {
    detail::Path& own = made.emplace_back();
    for (const Place& place : path)
      own.push_back(place_of(inner.map(), place,
                             fmt::format("/agents/{}/path/{}", made.size() - 1, own.size())));
  }
  return made;
}

detail::Visits visits_of(const detail::Instance& inner,
                         const std::vector<std::vector<Work>>& work) {
  if (static_cast<int>(work.size()) != inner.agent_count())
    throw InvalidArgument(
        "/work", fmt::format("{} lists of visits; expected {}", work.size(), inner.agent_count()));
  const auto tasks = tasks_by_id(inner);
  detail::Visits made;
  for (const std::vector<Work>& visits : work) {
    std::vector<detail::WorkTime>& own = made.emplace_back();
    for (const Work& visit : visits) {
      const std::string field = fmt::format("/work/{}/{}/task", made.size() - 1, own.size());
      own.push_back({task_of(tasks, visit.task, field), visit.begin, visit.end});
    }
  }
  return made;
}

}  // namespace

Plan plan_from_paths(const Instance& instance, const std::vector<std::vector<Place>>& paths) {
  const detail::Instance& inner = Access::instance(instance);
  const auto stated = std::ranges::find_if(inner.tasks(), &detail::Task::has_stated_visits);
  if (stated != inner.tasks().end())
    throw InvalidArgument(
        "/work",
        fmt::format("task '{}' {}; expected the visits that the plan "
                    "states",
                    stated->id, stated->duration > 0 ? "takes time" : "has a choice of agents"));
  return plan_from_paths(instance, paths, std::vector<std::vector<Work>>(paths.size()));
}

Plan plan_from_paths(const Instance& instance, const std::vector<std::vector<Place>>& paths,
                     const std::vector<std::vector<Work>>& work) {
  const detail::Instance& inner = Access::instance(instance);
  return with_public_exceptions([&] {
    std::vector<detail::Path> made = paths_of(inner, paths);
    return public_plan(inner,
                       detail::plan_of_paths(inner, std::move(made), visits_of(inner, work)));
  });
}

FixedChoices fix_choices(const Instance& instance, const Plan& plan) {
  return with_public_exceptions([&] {
    const detail::Instance& inner = Access::instance(instance);
    detail::FixedChoices fixed = detail::fix_choices(inner, valid_plan_of(inner, plan, ""));
    if (const auto error = detail::destination_within_a_road(fixed.instance))
      throw InvalidArgument("/agents", *error);
    Plan same = public_plan(fixed.instance, fixed.plan);
    return FixedChoices{Access::to_public(std::move(fixed.instance)), std::move(same)};
  });
}

Solution read_plan(const std::filesystem::path& path, const Instance& instance) {
  return with_public_exceptions([&] {
    const detail::Instance& inner = Access::instance(instance);
    return public_solution(inner, detail::read_solution(path, inner));
  });
}

Solution parse_plan(std::string_view text, const Instance& instance) {
  return with_public_exceptions([&] {
    const detail::Instance& inner = Access::instance(instance);
    return public_solution(inner, detail::parse_solution(text, "the plan", inner));
  });
}

namespace {

// Like with_public_exceptions(), but if the checker refuses a plan, throws InvalidArgument, because
// the plan is the caller's.
template <class Act>
auto refusing_invalid_plans(Act&& act) {
  return with_public_exceptions([&] {
    try {
      return act();
    } catch (const detail::InvalidPlan& error) {
      throw InvalidArgument(error.violation().json_pointer, error.violation().message);
    }
  });
}

}  // namespace

void write_plan(const std::filesystem::path& path, const Instance& instance,
                const Solution& solution) {
  refusing_invalid_plans([&] {
    const detail::Instance& inner = Access::instance(instance);
    detail::write_solution(path, inner, solution_of(inner, solution));
  });
}

std::string plan_text(const Instance& instance, const Solution& solution) {
  return refusing_invalid_plans([&] {
    const detail::Instance& inner = Access::instance(instance);
    return detail::solution_text(inner, solution_of(inner, solution));
  });
}

}  // namespace grove
