// SPDX-License-Identifier: MIT
// The definition of a valid plan (docs/design.md, section 1), written down a second time. It is
// meant to be compared with that section line by line, so it is direct rather than clever. First
// every agent's path is walked by itself: start, cells, steps, end, visits, cost. Then all agents
// are moved through time together on one map of who is where, so that the work grows with agents *
// time and not with agents^2. Last, the claims: a plan's cost is what its paths add up to, and its
// status is what cost, bound and omega deserve.
#include "grove/model/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <variant>

namespace grove {
namespace {

// Violations found so far; silently full after `limit`.
class Report {
 public:
  explicit Report(std::size_t limit) : limit_(limit) {}

  template <typename... Args>
  void add(std::string place, fmt::format_string<Args...> format, Args&&... args) {
    if (full()) return;
    violations_.push_back({std::move(place), fmt::format(format, std::forward<Args>(args)...)});
  }
  bool full() const { return violations_.size() >= limit_; }
  std::vector<Violation> take() { return std::move(violations_); }

 private:
  std::size_t limit_;
  std::vector<Violation> violations_;
};

// Which steps a map allows: said here from its cells or roads, not from the moves of its world.
class Steps {
 public:
  explicit Steps(const Map& map) : map_(map) {
    if (const auto* roadmap = std::get_if<Roadmap>(&map)) add_roads(*roadmap);
  }

  Place places() const {
    return std::visit([](const auto& map) { return map.place_count(); }, map_);
  }
  bool is_open(Place place) const {
    const auto* grid = std::get_if<Grid>(&map_);
    return grid == nullptr || grid->passable(place);
  }
  bool allow(Place from, Place to) const {
    const auto* grid = std::get_if<Grid>(&map_);
    if (from == to) return true;
    return grid ? are_neighbors(*grid, from, to) : on_roads_.contains({from, to});
  }
  // What is expected of one.
  std::string_view rule() const {
    return std::holds_alternative<Grid>(map_) ? "a wait or a move to one of 4 neighbors"
                                              : "a wait or a step along a road in its direction";
  }
  std::string name(Place place) const {
    return std::visit([&](const auto& map) { return map.name(place); }, map_);
  }

 private:
  static bool are_neighbors(const Grid& grid, Cell from, Cell to) {
    const Position a = grid.position(from);
    const Position b = grid.position(to);
    return std::abs(a.x - b.x) + std::abs(a.y - b.y) <= 1;
  }
  void add_roads(const Roadmap& roadmap) {
    for (int r = 0; r < static_cast<int>(roadmap.roads().size()); ++r)
      for (Time step = 1; step <= roadmap.roads()[r].steps; ++step) {
        const Place before = roadmap.place_on_road(r, step - 1);
        const Place after = roadmap.place_on_road(r, step);
        on_roads_.emplace(before, after);
        if (!roadmap.roads()[r].one_way) on_roads_.emplace(after, before);
      }
  }

  const Map& map_;
  std::set<std::pair<Place, Place>> on_roads_;
};

// One agent's path against what the agent must do.
class AgentCheck {
 public:
  AgentCheck(const Instance& instance, const Steps& steps, AgentIndex index, const AgentPlan& plan,
             Report& report)
      : instance_(instance),
        steps_(steps),
        agent_(instance.agent(index)),
        plan_(plan),
        report_(report),
        place_(fmt::format("/agents/{}", index)) {}

  // The time at which the agent finishes, if its path can be followed at all. Reports everything
  // that is wrong on the way.
  std::optional<Time> run() {
    if (plan_.path.empty()) {
      report_.add(place_, "agent '{}' has no path; expected one for every agent", agent_.id);
      return std::nullopt;
    }
    if (!walk()) return std::nullopt;
    check_end();
    check_visits();
    check_sequence();
    const Time finish = comes_to_rest();
    if (plan_.cost != finish)
      report_.add(place_ + "/cost", "agent '{}' finishes at time {}, but the plan says {}",
                  agent_.id, finish, plan_.cost);
    return finish;
  }

 private:
  std::string step_place(std::size_t time) const { return fmt::format("{}/path/{}", place_, time); }

  // Start, cells and steps.
  bool walk() {
    for (std::size_t t = 0; t < plan_.path.size(); ++t)
      if (!stands_well(t)) return false;
    if (plan_.path.front() != agent_.start)
      report_.add(step_place(0), "agent '{}' begins on {}; expected its start {}", agent_.id,
                  steps_.name(plan_.path.front()), steps_.name(agent_.start));
    for (std::size_t t = 1; t < plan_.path.size(); ++t) check_step(t);
    return true;
  }

  bool stands_well(std::size_t t) {
    const Place place = plan_.path[t];
    if (place < 0 || place >= steps_.places()) {
      report_.add(step_place(t), "agent '{}' is outside the map", agent_.id);
      return false;
    }
    if (!steps_.is_open(place))
      report_.add(step_place(t), "agent '{}' is on the blocked cell {}", agent_.id,
                  steps_.name(place));
    return true;
  }

  void check_step(std::size_t t) {
    const Place from = plan_.path[t - 1];
    const Place to = plan_.path[t];
    if (!steps_.allow(from, to))
      report_.add(step_place(t), "agent '{}' jumps from {} to {}; expected {}", agent_.id,
                  steps_.name(from), steps_.name(to), steps_.rule());
  }

  void check_end() {
    const Place end = plan_.path.back();
    const std::string place = step_place(plan_.path.size() - 1);
    if (agent_.goal && end != *agent_.goal)
      report_.add(place, "agent '{}' ends on {}; expected its goal {}", agent_.id, steps_.name(end),
                  steps_.name(*agent_.goal));
    const auto is_here = [&](TaskIndex task) { return instance_.task(task).cell == end; };
    if (!agent_.goal && std::ranges::none_of(agent_.tasks, is_here))
      report_.add(place, "agent '{}' ends on {}; expected one of its own tasks", agent_.id,
                  steps_.name(end));
  }

  void check_visits() {
    for (TaskIndex index : agent_.tasks) {
      const Task& task = instance_.task(index);
      if (std::ranges::find(plan_.path, task.cell) == plan_.path.end())
        report_.add(place_ + "/path", "agent '{}' never visits its task '{}' on {}", agent_.id,
                    task.id, steps_.name(task.cell));
    }
  }

  void check_sequence() {
    const std::string place = place_ + "/sequence";
    if (!std::ranges::is_permutation(plan_.sequence, agent_.tasks)) {
      report_.add(place, "expected every task of agent '{}' exactly once", agent_.id);
      return;
    }
    // Taking the first visit that is late enough is right: it leaves most time for the rest.
    auto now = plan_.path.begin();
    for (std::size_t k = 0; k < plan_.sequence.size(); ++k) {
      const Task& task = instance_.task(plan_.sequence[k]);
      now = std::find(now, plan_.path.end(), task.cell);
      if (now == plan_.path.end()) {
        report_.add(fmt::format("{}/{}", place, k),
                    "the path of agent '{}' does not visit task '{}' in this order", agent_.id,
                    task.id);
        return;
      }
    }
    check_last_task(place);
  }

  void check_last_task(const std::string& place) {
    if (agent_.goal || plan_.sequence.empty()) return;
    const Task& last = instance_.task(plan_.sequence.back());
    if (plan_.path.back() != last.cell)
      report_.add(fmt::format("{}/{}", place, plan_.sequence.size() - 1),
                  "agent '{}' has no goal and ends on {}; expected the last task of its sequence "
                  "there, found '{}'",
                  agent_.id, steps_.name(plan_.path.back()), last.id);
  }

  // From here on it stays for ever. All its visits lie before: later it is nowhere new.
  Time comes_to_rest() const {
    std::size_t time = plan_.path.size() - 1;
    while (time > 0 && plan_.path[time - 1] == plan_.path.back()) --time;
    return static_cast<Time>(time);
  }

  const Instance& instance_;
  const Steps& steps_;
  const Agent& agent_;
  const AgentPlan& plan_;
  Report& report_;
  std::string place_;
};

// Moves all agents through time together. Every path must stay inside the map.
class CollisionCheck {
 public:
  CollisionCheck(const Instance& instance, const Steps& steps, const Plan& plan, Report& report)
      : instance_(instance),
        steps_(steps),
        plan_(plan),
        report_(report),
        before_(static_cast<std::size_t>(steps.places()), kNobody),
        now_(static_cast<std::size_t>(steps.places()), kNobody) {}

  void run() {
    std::size_t end = 0;
    for (const AgentPlan& agent : plan_.agents) end = std::max(end, agent.path.size());
    for (std::size_t t = 0; t < end && !report_.full(); ++t) {
      for (AgentIndex i = 0; i < agent_count(); ++i) enter(i, t);
      if (t > 0)
        for (AgentIndex i = 0; i < agent_count(); ++i) check_swap(i, t);
      if (t > 0)
        for (AgentIndex i = 0; i < agent_count(); ++i) before_[at(i, t - 1)] = kNobody;
      std::swap(before_, now_);
    }
  }

 private:
  static constexpr AgentIndex kNobody = -1;

  AgentIndex agent_count() const { return static_cast<AgentIndex>(plan_.agents.size()); }

  Place at(AgentIndex agent, std::size_t time) const {
    const Path& path = plan_.agents[agent].path;
    return path[std::min(time, path.size() - 1)];
  }

  void enter(AgentIndex agent, std::size_t t) {
    const Place place = at(agent, t);
    const AgentIndex other = std::exchange(now_[place], agent);
    if (other != kNobody && is_new(vertex_pairs_, other, agent))
      report_.add(where(agent, t), "agents '{}' and '{}' are both on {} at time {}", id(other),
                  id(agent), steps_.name(place), t);
  }

  void check_swap(AgentIndex agent, std::size_t t) {
    const Place from = at(agent, t - 1);
    const Place to = at(agent, t);
    const AgentIndex other = before_[to];
    if (from == to || other == kNobody || other == agent || at(other, t) != from) return;
    if (is_new(edge_pairs_, other, agent))
      report_.add(where(agent, t), "agents '{}' and '{}' swap {} and {} between times {} and {}",
                  id(agent), id(other), steps_.name(from), steps_.name(to), t - 1, t);
  }

  const std::string& id(AgentIndex agent) const { return instance_.agent(agent).id; }

  std::string where(AgentIndex agent, std::size_t t) const {
    return fmt::format("/agents/{}/path/{}", agent,
                       std::min(t, plan_.agents[agent].path.size() - 1));
  }

  // Two agents that collide once tend to collide for long: the first time says it.
  using Pairs = std::set<std::pair<AgentIndex, AgentIndex>>;
  static bool is_new(Pairs& pairs, AgentIndex a, AgentIndex b) {
    return pairs.insert(std::minmax(a, b)).second;
  }

  const Instance& instance_;
  const Steps& steps_;
  const Plan& plan_;
  Report& report_;
  std::vector<AgentIndex> before_;  // by place: an agent that was there at time t - 1
  std::vector<AgentIndex> now_;
  Pairs vertex_pairs_;
  Pairs edge_pairs_;
};

// The cost that the paths add up to; none when a path cannot be followed.
std::optional<Cost> check_agents(const Instance& instance, const Steps& steps, const Plan& plan,
                                 Report& report) {
  std::optional<Cost> total = 0;
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const auto finish = AgentCheck(instance, steps, i, plan.agents[i], report).run();
    if (!finish) total.reset();
    if (total) *total += *finish;
  }
  return total;
}

// What a plan of this cost may be called, given the claimed bound.
Status deserved_status(Cost cost, Cost lower_bound, Omega omega) {
  if (cost == lower_bound) return Status::kOptimal;
  const bool within = !omega.is_infinite() && omega.accepts(cost, lower_bound);
  return within ? Status::kBounded : Status::kFeasible;
}

void check_claims(const Solution& solution, Cost cost, Report& report) {
  if (solution.plan->cost != cost)
    report.add("/cost", "the agents' costs add up to {}, but the plan says {}", cost,
               solution.plan->cost);
  if (solution.lower_bound < 0)
    report.add("/lower_bound", "found {}; expected at least 0", solution.lower_bound);
  if (solution.lower_bound > cost)
    report.add("/lower_bound", "a lower bound of {} cannot be: this plan costs {}",
               solution.lower_bound, cost);
  const Status deserved = deserved_status(cost, solution.lower_bound, solution.omega);
  if (solution.lower_bound <= cost && solution.status != deserved)
    report.add("/status", "found '{}'; expected '{}' with cost {}, lower bound {} and omega {}",
               to_string(solution.status), to_string(deserved), cost, solution.lower_bound,
               solution.omega.to_string());
}

}  // namespace

std::vector<Violation> check(const Instance& instance, const Solution& solution,
                             std::size_t limit) {
  Report report(std::max<std::size_t>(limit, 1));
  if (!solution.plan) {
    report.add("/status", "there is no plan ('{}'); expected a path for every agent",
               to_string(solution.status));
    return report.take();
  }
  const Plan& plan = *solution.plan;
  if (plan.agents.size() != static_cast<std::size_t>(instance.agent_count())) {
    report.add("/agents", "the plan has {} agents; expected {}", plan.agents.size(),
               instance.agent_count());
    return report.take();
  }
  const Steps steps(instance.map());
  if (const auto cost = check_agents(instance, steps, plan, report)) {
    CollisionCheck(instance, steps, plan, report).run();
    check_claims(solution, *cost, report);
  }
  return report.take();
}

}  // namespace grove
