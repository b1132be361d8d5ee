// SPDX-License-Identifier: MIT
// The stops of an agent are those of its tasks that it must visit (Agent::stops), and then its
// optional tasks. Only visits to optional tasks count for a need.
//
// *Claim: each plan visits the stops of a joint route in its order, and each agent ends as the
// route states. So no plan costs less than the cheapest joint route.*
// *Proof.* If more agents state a visit to a task with a choice than it needs, one of them does not
// rest on the place of the task, because agents rest on different places. Without its statement the
// plan is valid and does not cost more. So let exactly as many agents as needed state visits. The
// visits of an agent in the order of their times are its sequence. Of several plain tasks on one
// place that it visits at one time, those with the lower number come first; therefore the leg to a
// lower one does not exist. (A plain task without a choice has no stated time. It is visited
// whenever the agent is on its place; any of these times will do.) The ends are:
//
// - A destination: its place. A place is a resource, because agents rest on different places.
// - An idle agent ends anywhere.
// - An agent without a destination that must visit a task rests on the place of a task that it has
//   visited. If none of the agent's tasks takes time, this visit is the last one, because it can be
//   stated at the end of the path.
//
// *Exactness.* Each joint route has such paths of its cost if agents turn freely.
#include "assignment/instance_routes.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "assignment/routes.h"
#include "model/choices.h"

namespace grove::detail {
namespace {

// The states in which the agent may rest on `place`.
std::vector<State> states_of_rest(const Instance& instance, AgentIndex agent, Place place) {
  const bool has_destination = instance.agent(agent).has_destination();
  std::vector<State> states;
  instance.world().for_each_state(place, [&](State state) {
    if (!has_destination || instance.may_rest(agent, state)) states.push_back(state);
  });
  return states;
}

bool any_takes_time(const Instance& instance, const std::vector<TaskIndex>& tasks) {
  return std::ranges::any_of(tasks, [&](TaskIndex t) { return instance.task(t).duration > 0; });
}

}  // namespace

void require_joint_routes(const Instance& instance, std::string_view reason,
                          std::string_view remedy) {
  const auto refuse = [&](AgentIndex agent, const std::string& what) {
    const Agent& a = instance.agent(agent);
    const Choice choice = a.goals.empty() ? choice_of_agents(instance, a.options.front())
                                          : choice_of_goals(instance, agent);
    throw InstanceError(fmt::format("agents/{}", agent),
                        refusal_text({choice.field, fmt::format("agent '{}' {}", a.id, what),
                                      "an agent without a choice"},
                                     reason, remedy));
  };
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const Agent& agent = instance.agent(i);
    if (!agent.has_choice()) continue;
    if (agent.kind > 0) refuse(i, "has a choice and needs time to turn");
    const auto begun = task_at_start(instance, i);
    if (begun && !instance.task(*begun).needs_all())
      refuse(i, "starts at work on a task with a choice of agents");
    if (agent.stops.size() + agent.options.size() > kMaxTasksPerAgent)
      refuse(i, fmt::format("must or may visit more than {} tasks", kMaxTasksPerAgent));
  }
}

InstanceRoutes::InstanceRoutes(const Instance& instance, const DistanceFields& distances)
    : instance_(instance), distances_(distances) {
  for (const Task& task : instance.tasks()) {
    shared_tasks_.push_back(task.needs_all() ? -1 : static_cast<int>(problem_.needs.size()));
    if (!task.needs_all()) problem_.needs.push_back(task.need);
  }
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) add_agent(agent);
  problem_.resources = static_cast<int>(resources_.size());
}

void InstanceRoutes::add_agent(AgentIndex agent) {
  const Agent& who = instance_.agent(agent);
  std::vector<TaskIndex>& stops = stops_.emplace_back(who.stops);
  stops.insert(stops.end(), who.options.begin(), who.options.end());
  AgentRoutes& routes = problem_.agents.emplace_back();
  for (const TaskIndex task : stops) routes.tasks.push_back(shared_tasks_[task]);
  routes.required = all_stops(static_cast<int>(who.stops.size()));
  routes.legs = legs(agent);
  rests_.emplace_back();
  add_ends(agent);
}

CostMatrix::Matrix InstanceRoutes::legs(AgentIndex agent) const {
  const Agent& who = instance_.agent(agent);
  const World& world = instance_.world();
  const std::vector<TaskIndex>& stops = stops_[agent];
  const int n = static_cast<int>(stops.size());
  CostMatrix::Matrix legs(n + 1, kNever);
  const auto is_plain = [&](int stop) { return instance_.task(stops[stop]).duration == 0; };
  for (int to = 0; to < n; ++to) {
    const DistanceView distance = distances_.to_task(stops[to]);
    for (int from = 0; from < n; ++from) {
      const Place place = instance_.task(stops[from]).cell;
      const bool is_same =
          place == instance_.task(stops[to]).cell && is_plain(from) && is_plain(to);
      if (from != to && !(is_same && from > to))
        legs(from, to) = min_distance_from(world, place, who.kind, distance);
    }
    // An agent that starts during a task execution completes it first.
    if (!world.is_working(who.start) || world.work(who.start).task == stops[to])
      legs(n, to) = distance[who.start];
  }
  return legs;
}

void InstanceRoutes::add_ends(AgentIndex agent) {
  const Agent& who = instance_.agent(agent);
  if (who.has_destination()) {
    for (const Place goal : who.destinations())
      add_end(agent, {.resource = resource_of(goal)}, rest_on(agent, goal));
  } else if (who.is_idle() || (who.options.empty() && !instance_.rests_on_last_stop(agent))) {
    add_end(agent, {}, PlaceOfRest{kNoPlace, distances_.to_rest(agent)});
  } else if (any_takes_time(instance_, stops_[agent])) {
    std::set<Place> places;
    for (const TaskIndex task : stops_[agent]) places.insert(instance_.task(task).cell);
    for (const Place place : places)
      add_end(agent, {.resource = resource_of(place), .any_of = stops_on(agent, place)},
              rest_on(agent, place));
  } else {
    add_end(agent, {}, std::nullopt);
  }
}

// Sets the costs of the last legs and adds the end.
void InstanceRoutes::add_end(AgentIndex agent, RouteEnd end, std::optional<PlaceOfRest> rest) {
  const Agent& who = instance_.agent(agent);
  if (rest) end.from_start = rest->distances[who.start];
  for (const TaskIndex task : stops_[agent])
    end.from_stops.push_back(rest ? min_distance_from(instance_.world(), instance_.task(task).cell,
                                                      who.kind, rest->distances)
                                  : 0);
  problem_.agents[agent].ends.push_back(std::move(end));
  rests_[agent].push_back(rest);
}

StopSet InstanceRoutes::stops_on(AgentIndex agent, Place place) const {
  StopSet here = 0;
  for (std::size_t stop = 0; stop < stops_[agent].size(); ++stop)
    if (instance_.task(stops_[agent][stop]).cell == place) here |= bit(static_cast<int>(stop));
  return here;
}

PlaceOfRest InstanceRoutes::rest_on(AgentIndex agent, Place place) {
  const Agent& who = instance_.agent(agent);
  const auto [known, is_new] = fields_.try_emplace({place, who.kind, who.goal_heading});
  if (is_new)
    known->second = distance_field(instance_.world(), states_of_rest(instance_, agent, place));
  return {place, DistanceView(known->second)};
}

int InstanceRoutes::resource_of(Place place) {
  return resources_.try_emplace(place, static_cast<int>(resources_.size())).first->second;
}

std::vector<TaskIndex> InstanceRoutes::visits(AgentIndex agent, const Sequence& stops) const {
  std::vector<TaskIndex> tasks;
  for (const Stop stop : stops) tasks.push_back(stops_[agent][stop]);
  return tasks;
}

GoalSequence InstanceRoutes::goals(AgentIndex agent, const AgentRoute& route) const {
  return {instance_, distances_, agent, visits(agent, route.stops),
          rests_[agent][static_cast<std::size_t>(route.end)]};
}

}  // namespace grove::detail
