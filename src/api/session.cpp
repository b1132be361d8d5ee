// SPDX-License-Identifier: MIT
#include "grove/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "api/access.h"
#include "api/run.h"
#include "engine/session.h"

namespace grove {
namespace {

detail::AgentIndex agent_of(const detail::Instance& instance, const std::string& id,
                            const std::string& field) {
  const auto agents = instance.agents();
  const auto found = std::ranges::find(agents, id, &detail::Agent::id);
  if (found == agents.end())
    throw InvalidArgument(field, fmt::format("there is no agent '{}'", id));
  return static_cast<detail::AgentIndex>(found - agents.begin());
}

// Returns the ids of the agents of a new task.
std::vector<std::string> agents_of(const detail::Instance& instance, const Task& task,
                                   const std::string& field) {
  std::vector<std::string> ids = task.agents;
  if (task.all_agents) {
    ids = instance.agent_ids();
    if (!task.agents.empty() && !std::ranges::is_permutation(task.agents, ids))
      throw InvalidArgument(field + "/agents",
                            "found a list of some agents, and all_agents; "
                            "expected one of them");
  }
  return ids;
}

}  // namespace

struct Session::Impl {
  detail::Session session;
};

Session::Session(Instance instance)
    : impl_(with_public_exceptions([&] {
        return std::make_unique<Impl>(Impl{detail::Session(Access::instance(instance))});
      })) {}

Session::Session(Instance instance, const Plan& plan)
    : impl_(with_public_exceptions([&] {
        const detail::Instance& inner = Access::instance(instance);
        return std::make_unique<Impl>(
            Impl{detail::Session(inner, valid_plan_of(inner, plan, "/plan"))});
      })) {}

Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

Instance Session::instance() const {
  return Access::to_public(impl_->session.instance());
}

std::optional<Plan> Session::plan() const {
  const detail::Session& session = impl_->session;
  if (!session.plan()) return std::nullopt;
  return public_plan(session.instance(), *session.plan());
}

void Session::advance(int steps, const std::vector<Delay>& late) {
  detail::Session& session = impl_->session;
  if (!session.plan()) throw InvalidArgument("", "there is no plan; expected one to advance along");
  if (steps < 0)
    throw InvalidArgument("/steps", fmt::format("found {}; expected at least 0", steps));
  std::vector<detail::Delay> delays;
  for (std::size_t i = 0; i < late.size(); ++i) {
    const std::string field = fmt::format("/late/{}", i);
    delays.push_back({agent_of(session.instance(), late[i].agent, field), late[i].steps});
    if (late[i].steps < 0) throw InvalidArgument(field, "expected at least 0 steps");
  }
  with_public_exceptions([&] {
    try {
      session.advance(steps, delays);
    } catch (const detail::InfeasibleDelay& error) {
      throw InvalidArgument("/late", error.what());
    }
  });
}

void Session::change(const Change& change) {
  detail::Session& session = impl_->session;
  const detail::Map& map = session.instance().map();
  detail::InstanceChange made;
  made.dropped_tasks = change.dropped_tasks;
  for (std::size_t i = 0; i < change.new_tasks.size(); ++i) {
    const Task& task = change.new_tasks[i];
    const std::string field = fmt::format("/new_tasks/{}", i);
    const detail::Place place = place_of(map, task.place, field + "/place");
    made.new_tasks.push_back(
        {task.id, place, agents_of(session.instance(), task, field), task.duration, task.need});
  }
  for (std::size_t i = 0; i < change.blocked.size(); ++i)
    made.blocked.push_back(place_of(map, change.blocked[i], fmt::format("/blocked/{}", i)));
  with_public_exceptions([&] { session.change(made); });
}

Options Session::default_options() {
  Options options;
  options.time_limit = 1;
  return options;
}

Solution Session::replan(const Options& options, int commit) {
  detail::Session& session = impl_->session;
  if (commit < 0)
    throw InvalidArgument("/commit", fmt::format("found {}; expected at least 0", commit));
  Options own = options;
  own.start.reset();
  const detail::SolveOptions search = search_options_of(session.instance(), own);
  Run run(session.instance(), own);
  const auto search_on = [&](const detail::Limits& limits, detail::RunObserver& observer) {
    try {
      return session.solve(search, limits, &observer, commit);
    } catch (const detail::Session::NotCommitted& error) {
      throw InvalidArgument("/commit",
                            fmt::format("'{}' can follow the old plan only for {} steps",
                                        session.instance().agent(error.agent).id, error.steps));
    }
  };
  const detail::Solution solution = run([&](const auto& limits, auto& observer) {
    return with_public_exceptions([&] { return search_on(limits, observer); });
  });
  return public_solution(session.instance(), solution);
}

}  // namespace grove
