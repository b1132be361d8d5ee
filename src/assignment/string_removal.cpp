// SPDX-License-Identifier: MIT
// A change begins at a random visit and removes strings of successive visits from the routes that
// visit the nearest tasks, one string per route. Then it inserts the visits again one by one, each
// at its cheapest position: an optional visit in the routes of all agents of the task, a required
// one in the route of its agent. Some positions are left out at random.
#include "assignment/string_removal.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace grove::detail {
namespace {

constexpr std::size_t kNearTasks = 40;  // nearest tasks of a task
constexpr int kBlinks = 100;            // one position in this many is left out

}  // namespace

StringRemoval::StringRemoval(Routes& routes, Random& random, Size size)
    : routes_(routes), instance_(routes.costs().instance()), random_(random), size_(size) {
  find_neighbors();
  begin();
}

void StringRemoval::find_neighbors() {
  for (TaskIndex task = 0; task < instance_.task_count(); ++task) {
    std::vector<TaskIndex>& neighbors = neighbors_.emplace_back();
    if (instance_.task(task).agents.empty()) continue;
    const AgentIndex any = instance_.task(task).agents.front();
    std::vector<std::pair<Time, TaskIndex>> near;
    for (TaskIndex other = 0; other < instance_.task_count(); ++other)
      near.emplace_back(routes_.costs().between(any, task, other), other);
    const std::size_t count = std::min(kNearTasks, near.size());
    std::ranges::partial_sort(near, near.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t k = 0; k < count; ++k) neighbors.push_back(near[k].second);
  }
}

void StringRemoval::begin() {
  visitors_.assign(instance_.tasks().size(), {});
  for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent)
    for (const TaskIndex task : routes_.stops(agent)) visitors_[task].push_back(agent);
  tasks_.clear();
  for (TaskIndex task = 0; task < instance_.task_count(); ++task)
    if (!visitors_[task].empty()) tasks_.push_back(task);
}

std::optional<Cost> StringRemoval::apply() {
  saved_.clear();
  removed_.clear();
  Cost change = -remove_strings();
  order_removed();
  for (const Visit& visit : removed_) {
    const std::optional<Time> cost = insert(visit);
    if (!cost) {
      undo();
      return std::nullopt;
    }
    change += *cost;
  }
  return change;
}

// Returns by how much the cost of the routes falls.
Cost StringRemoval::remove_strings() {
  const TaskIndex seed = tasks_[random_.below(tasks_.size())];
  const int longest = 1 + random_.below(size_.longest);
  const int strings = 1 + random_.below(std::max(1, 2 * size_.mean / longest));
  Cost gain = 0;
  for (const TaskIndex task : neighbors_[seed]) {
    if (std::ssize(saved_) >= strings) break;
    const std::vector<AgentIndex> visitors = visitors_[task];
    for (const AgentIndex agent : visitors)
      if (!is_saved(agent)) gain += remove_string(agent, task, longest);
  }
  return gain;
}

Cost StringRemoval::remove_string(AgentIndex agent, TaskIndex task, int longest) {
  const std::vector<TaskIndex> stops = routes_.stops(agent);
  const auto at = static_cast<int>(std::ranges::find(stops, task) - stops.begin());
  const int first_free = task_at_start(instance_, agent) ? 1 : 0;
  const int length = std::min(longest, static_cast<int>(stops.size()) - first_free);
  if (at < first_free || length == 0) return 0;
  const int least = std::max(first_free, at - length + 1);
  const int most = std::min(at, static_cast<int>(stops.size()) - length);
  const int first = least + random_.below(most - least + 1);
  save(agent);
  Cost gain = 0;
  for (int k = first; k < first + length; ++k) {
    const TaskIndex removed = stops[k];
    removed_.push_back({removed, instance_.task(removed).needs_all() ? agent : kAny});
    std::erase(visitors_[removed], agent);
    gain += routes_.remove(agent, removed);
  }
  return gain;
}

// At random, or those far from the start of their first agent first or last.
void StringRemoval::order_removed() {
  random_.shuffle(removed_);
  const auto distance = [&](const Visit& visit) {
    const AgentIndex agent =
        visit.agent == kAny ? instance_.task(visit.task).agents.front() : visit.agent;
    return routes_.costs().from_start(agent, visit.task);
  };
  const int order = random_.below(4);
  if (order == 0) std::ranges::stable_sort(removed_, {}, distance);
  if (order == 1) std::ranges::stable_sort(removed_, std::greater(), distance);
}

std::optional<Time> StringRemoval::insert(const Visit& visit) {
  Insertion best;
  AgentIndex best_agent = kAny;
  const auto consider = [&](AgentIndex agent) {
    const Insertion here =
        routes_.cheapest(agent, visit.task, [this] { return random_.below(kBlinks) > 0; });
    ++insertions_;
    if (here.cost >= best.cost) return;
    best = here;
    best_agent = agent;
  };
  if (visit.agent != kAny)
    consider(visit.agent);
  else
    for (const AgentIndex agent : instance_.task(visit.task).agents) consider(agent);
  if (best_agent == kAny) return std::nullopt;
  save(best_agent);
  routes_.insert(best_agent, visit.task, best.position);
  visitors_[visit.task].push_back(best_agent);
  return best.cost;
}

bool StringRemoval::is_saved(AgentIndex agent) const {
  return std::ranges::find(saved_, agent, &Saved::agent) != saved_.end();
}

void StringRemoval::save(AgentIndex agent) {
  if (!is_saved(agent)) saved_.push_back({agent, routes_.stops(agent)});
}

void StringRemoval::undo() {
  for (const Saved& saved : saved_) {
    for (const TaskIndex task : routes_.stops(saved.agent))
      std::erase(visitors_[task], saved.agent);
    routes_.set_stops(saved.agent, saved.stops);
    for (const TaskIndex task : saved.stops) visitors_[task].push_back(saved.agent);
  }
}

}  // namespace grove::detail
