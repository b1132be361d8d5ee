// SPDX-License-Identifier: MIT
#include "execution/change.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

// A map without the closed places and roads, and the new numbers of the remaining places.
struct ClosedMap {
  std::shared_ptr<const Map> map;
  std::vector<Place> places;  // by place of the earlier map; kNoPlace: closed
};

ClosedMap close_cells(const Grid& grid, const std::vector<Place>& blocked) {
  std::vector<bool> passable;
  std::vector<Place> places(static_cast<std::size_t>(grid.cell_count()));
  std::iota(places.begin(), places.end(), 0);
  for (const Place place : blocked) places[place] = kNoPlace;
  for (Cell cell = 0; cell < grid.cell_count(); ++cell)
    passable.push_back(grid.passable(cell) && places[cell] != kNoPlace);
  return {std::make_shared<const Map>(Grid(grid.width(), grid.height(), passable)), places};
}

bool is_closed(const Roadmap& roadmap, int road, const InstanceChange& change) {
  const Road& r = roadmap.roads()[road];
  const auto is_blocked = [&](int vertex) {
    return std::ranges::count(change.blocked, roadmap.place_of_vertex(vertex)) > 0;
  };
  return std::ranges::count(change.closed_roads, road) > 0 || is_blocked(r.from) ||
         is_blocked(r.to);
}

ClosedMap close_roads(const Roadmap& roadmap, const InstanceChange& change) {
  std::vector<Road> roads;
  std::vector<int> number;  // by road of the earlier map: its new number; -1: closed
  for (int road = 0; road < static_cast<int>(roadmap.roads().size()); ++road) {
    const bool closed = is_closed(roadmap, road, change);
    number.push_back(closed ? -1 : static_cast<int>(roads.size()));
    if (!closed) roads.push_back(roadmap.roads()[road]);
  }
  auto map = std::make_shared<const Map>(Roadmap(roadmap.vertices(), std::move(roads)));
  const Roadmap& rest = std::get<Roadmap>(*map);
  std::vector<Place> places;
  for (Place place = 0; place < roadmap.place_count(); ++place) {
    const Roadmap::Spot spot = roadmap.spot(place);
    if (spot.vertex >= 0)
      places.push_back(std::ranges::count(change.blocked, place) > 0
                           ? kNoPlace
                           : rest.place_of_vertex(spot.vertex));
    else
      places.push_back(number[spot.road] < 0 ? kNoPlace
                                             : rest.place_on_road(number[spot.road], spot.steps));
  }
  GROVE_ASSERT(std::ranges::count_if(places, [](Place place) { return place != kNoPlace; }) +
                       std::ssize(change.blocked) >=
                   rest.place_count(),
               "each place of the new map is one of the earlier map");
  return {std::move(map), std::move(places)};
}

class ChangeApplication {
 public:
  ChangeApplication(const Instance& instance, const Plan& plan, const InstanceChange& change)
      : instance_(instance), plan_(plan), change_(change), dropped_(dropped()) {
    require_free();
    if (change.blocked.empty() && change.closed_roads.empty())
      closed_.map = instance.shared_map();
    else
      closed_ = instance.is_on_grid() ? close_cells(instance.grid(), change.blocked)
                                      : close_roads(*instance.roadmap(), change);
  }

  Changed run() {
    std::vector<TaskIndex> tasks(instance_.tasks().size(), -1);
    Changed changed{build(tasks), {}, {}, {}};
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
      changed.plan.agents.push_back(agent_plan(changed.instance, agent, tasks));
      changed.plan.cost += changed.plan.agents.back().cost;
      changed.cut.push_back(changed.plan.agents.back().path.size() <
                            plan_.agents[agent].path.size());
      changed.affected.push_back(is_affected(agent, changed));
    }
    return changed;
  }

 private:
  Place place_now(Place before) const {
    return closed_.places.empty() ? before : closed_.places[before];
  }

  std::vector<bool> dropped() const {
    std::vector<bool> dropped(instance_.tasks().size());
    for (std::size_t i = 0; i < change_.dropped_tasks.size(); ++i) {
      const std::string& id = change_.dropped_tasks[i];
      const auto found = std::ranges::find(instance_.tasks(), id, &Task::id);
      if (found == instance_.tasks().end())
        throw InstanceError(
            fmt::format("dropped_tasks/{}", i),
            fmt::format("there is no remaining task '{}'; expected one that is not visited yet",
                        id));
      dropped[found - instance_.tasks().begin()] = true;
    }
    return dropped;
  }

  void require_free() const {
    for (std::size_t i = 0; i < change_.blocked.size(); ++i)
      require_nothing_at(change_.blocked[i], fmt::format("blocked/{}", i));
    const Roadmap* roadmap = instance_.roadmap();
    for (const Agent& agent : instance_.agents()) {
      const Place start = instance_.world().place(agent.start);
      if (!roadmap || roadmap->spot(start).vertex >= 0) continue;
      const int road = roadmap->spot(start).road;
      if (is_closed(*roadmap, road, change_))
        throw InstanceError(field_of(*roadmap, road),
                            fmt::format("'{}' is on that road", agent.id));
    }
  }

  void require_nothing_at(Place blocked, const std::string& field) const {
    if (instance_.is_on_grid() && !instance_.grid().passable(blocked))
      throw InstanceError(field, "the map is blocked there already; expected a passable cell");
    for (const Agent& agent : instance_.agents()) {
      if (instance_.world().place(agent.start) == blocked)
        throw InstanceError(field, fmt::format("'{}' is there", agent.id));
      if (agent.goal == blocked)
        throw InstanceError(field, fmt::format("it is the destination of '{}'", agent.id));
      if (std::ranges::count(agent.goals, blocked) > 0 &&
          std::ranges::all_of(agent.goals, [&](Place goal) { return is_blocked(goal); }))
        throw InstanceError(field, fmt::format("no goal of '{}' is left", agent.id));
    }
    for (TaskIndex task = 0; task < instance_.task_count(); ++task)
      if (!dropped_[task] && instance_.task(task).cell == blocked)
        throw InstanceError(field,
                            fmt::format("task '{}' is there; expected that it is dropped as well",
                                        instance_.task(task).id));
  }

  bool is_blocked(Place place) const { return std::ranges::count(change_.blocked, place) > 0; }

  // The JSON field of the change that closes the road.
  std::string field_of(const Roadmap& roadmap, int road) const {
    const auto found = std::ranges::find(change_.closed_roads, road);
    if (found != change_.closed_roads.end())
      return fmt::format("closed_roads/{}", found - change_.closed_roads.begin());
    const Road& r = roadmap.roads()[road];
    const auto end = std::ranges::find_if(change_.blocked, [&](Place place) {
      return place == roadmap.place_of_vertex(r.from) || place == roadmap.place_of_vertex(r.to);
    });
    return fmt::format("blocked/{}", end - change_.blocked.begin());
  }

  // Builds the changed instance. Sets tasks[i] to the new index of each old task i that is kept.
  // The caller must fill `tasks` with -1, which stays for dropped tasks.
  Instance build(std::vector<TaskIndex>& tasks) const {
    InstanceBuilder builder(closed_.map);
    if (!instance_.may_follow()) builder.forbid_following();
    for (AgentIndex i = 0; i < instance_.agent_count(); ++i) {
      AgentSpec spec = instance_.spec(i);
      spec.start.place = place_now(spec.start.place);
      if (spec.goal) spec.goal = place_now(*spec.goal);
      std::erase_if(spec.goals, [&](Place goal) { return is_blocked(goal); });
      for (Place& goal : spec.goals) goal = place_now(goal);
      GROVE_CHECK(spec.start.place != kNoPlace && spec.goal.value_or(0) != kNoPlace,
                  "the start and the destination of an agent stay open");
      if (spec.working && is_dropped(spec.working->task)) spec.working.reset();
      builder.add_agent(std::move(spec));
    }
    for (TaskIndex i = 0; i < instance_.task_count(); ++i) {
      const Task& task = instance_.task(i);
      if (dropped_[i]) continue;
      std::vector<std::string> agents;
      for (const AgentIndex agent : task.agents) agents.push_back(instance_.agent(agent).id);
      tasks[i] = builder.add_task(task.id, place_now(task.cell), agents, task.duration, task.need);
    }
    for (std::size_t i = 0; i < change_.new_tasks.size(); ++i) add_new(builder, i);
    return std::move(builder).build();
  }

  bool is_dropped(const std::string& task) const {
    return std::ranges::count(change_.dropped_tasks, task) > 0;
  }

  void add_new(InstanceBuilder& builder, std::size_t number) const {
    const NewTask& task = change_.new_tasks[number];
    const auto fail = [&](const std::string& field, const std::string& message) {
      throw InstanceError(fmt::format("new_tasks/{}/{}", number, field), message);
    };
    if (place_now(task.place) == kNoPlace) fail("cell", "it is blocked");
    try {
      builder.add_task(task.id, place_now(task.place), task.agents, task.duration, task.need);
    } catch (const InstanceError& error) {
      fail(error.field(), error.what());
    }
  }

  // The part of the agent's plan that is still possible on the new map.
  AgentPlan agent_plan(const Instance& now, AgentIndex agent,
                       const std::vector<TaskIndex>& tasks) const {
    const AgentPlan& before = plan_.agents[agent];
    AgentPlan plan;
    for (const TaskIndex task : before.sequence)
      if (tasks[task] >= 0) plan.sequence.push_back(tasks[task]);
    for (const State state : before.path) {
      Pose pose = instance_.pose_of(state);
      pose.place = place_now(pose.place);
      if (pose.place == kNoPlace) break;
      const State then = now.state_of(agent, pose);
      if (!plan.path.empty() && !leads_to(now.world(), plan.path.back(), then)) break;
      plan.path.push_back(then);
    }
    GROVE_CHECK(!plan.path.empty(), "an agent keeps at least its start");
    const Time end = static_cast<Time>(plan.path.size()) - 1;
    for (const WorkTime& work : before.work)
      if (tasks[work.task] >= 0 && work.end <= end)
        plan.work.push_back({tasks[work.task], work.begin, work.end});
    plan.cost = end;
    return plan;
  }

  // True if an agent can get from `from` to `to` in one step, by a wait or a move.
  static bool leads_to(const World& world, State from, State to) {
    return from == to || std::ranges::count(world.moves(from), to) > 0;
  }

  bool is_affected(AgentIndex agent, const Changed& changed) const {
    const auto has_dropped = [&](TaskIndex task) { return dropped_[task]; };
    const AgentPlan& now = changed.plan.agents[agent];
    const auto is_missing = [&](TaskIndex task) {
      return std::ranges::count(now.sequence, task) == 0;
    };
    return std::ranges::any_of(instance_.agent(agent).tasks, has_dropped) ||
           std::ranges::any_of(plan_.agents[agent].sequence, has_dropped) || changed.cut[agent] ||
           std::ranges::any_of(changed.instance.agent(agent).tasks, is_missing);
  }

  const Instance& instance_;
  const Plan& plan_;
  const InstanceChange& change_;
  const std::vector<bool> dropped_;  // by task
  ClosedMap closed_;
};

}  // namespace

Changed apply(const Instance& instance, const Plan& plan, const InstanceChange& change) {
  return ChangeApplication(instance, plan, change).run();
}

}  // namespace grove::detail
