// SPDX-License-Identifier: MIT
#include "grove/detail/model/distance_field.h"

#include <algorithm>
#include <map>

namespace grove::detail {
namespace {

// What the agents of an instance must reach, each set of states once.
class Targets {
 public:
  explicit Targets(const Instance& instance) : instance_(instance) {
    for (TaskIndex task = 0; task < instance.task_count(); ++task)
      of_tasks.push_back(instance.task(task).duration == 0 ? on_place(instance.task(task).cell)
                                                           : add(instance.states_visiting(task)));
    for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent)
      of_agents.push_back(to_rest(agent));
  }

  std::vector<std::vector<State>> sets;
  std::vector<Place> places;  // by set: all that stand there; kNoPlace: others
  // Numbers of sets; kNone: there is none to be reached.
  static constexpr int kNone = -1;
  std::vector<int> of_tasks;
  std::vector<int> of_agents;

 private:
  int add(std::vector<State> states, Place place = kNoPlace) {
    sets.push_back(std::move(states));
    places.push_back(place);
    return static_cast<int>(sets.size()) - 1;
  }
  int on_place(Place place) {
    const auto [known, is_new] = by_place_.try_emplace(place, 0);
    if (is_new) {
      std::vector<State> states;
      instance_.world().for_each_state(place, [&](State state) { states.push_back(state); });
      known->second = add(std::move(states), place);
    }
    return known->second;
  }
  int to_rest(AgentIndex index) {
    const Agent& agent = instance_.agent(index);
    if (agent.goal && !agent.goal_heading) return on_place(*agent.goal);
    if (instance_.rests_on_last_stop(index)) return kNone;
    if (!agent.is_idle()) return add(instance_.states_to_rest(index));
    if (anywhere_ == kNone) {
      std::vector<State> all(static_cast<std::size_t>(instance_.world().state_count()));
      for (std::size_t s = 0; s < all.size(); ++s) all[s] = static_cast<State>(s);
      anywhere_ = add(std::move(all));
    }
    return anywhere_;
  }

  const Instance& instance_;
  std::map<Place, int> by_place_;
  int anywhere_ = kNone;
};

}  // namespace

DistanceField distance_field(const World& world, std::span<const State> targets) {
  DistanceField distance(static_cast<std::size_t>(world.state_count()), kNever);
  std::vector<State> queue;
  const auto reach = [&](State state, Time steps) {
    if (distance[state] != kNever) return;
    distance[state] = steps;
    queue.push_back(state);
  };
  for (const State state : targets) reach(state, 0);
  for (std::size_t head = 0; head < queue.size(); ++head)
    for (State before : world.moves_to(queue[head])) reach(before, distance[queue[head]] + 1);
  return distance;
}

DistanceField distance_field(const World& world, Place target) {
  std::vector<State> states;
  world.for_each_state(target, [&](State state) { states.push_back(state); });
  return distance_field(world, states);
}

DistanceFields::DistanceFields(const Instance& instance, const Limits& limits,
                               const DistanceFields* known) {
  if (instance.world().states_are_places()) map_ = instance.shared_map();
  const Targets targets(instance);
  const auto states = static_cast<std::size_t>(instance.world().state_count());
  if (!limits.memory_allows(targets.sets.size() * states * sizeof(Time))) {
    limits.memory_exhausted();
    return;
  }
  for (std::size_t set = 0; set < targets.sets.size(); ++set) {
    if (limits.stop_requested()) return;
    FieldPtr field = field_to(targets.places[set], known);
    if (!field)
      field = std::make_shared<DistanceField>(distance_field(instance.world(), targets.sets[set]));
    if (map_ && targets.places[set] != kNoPlace) to_place_.emplace(targets.places[set], field);
    fields_.push_back(std::move(field));
  }
  for (const int set : targets.of_tasks) by_task_.push_back(fields_[set].get());
  for (const int set : targets.of_agents)
    by_agent_.push_back(set == Targets::kNone ? nullptr : fields_[set].get());
  complete_ = add_ports(instance, limits);
}

DistanceFields::FieldPtr DistanceFields::field_to(Place place, const DistanceFields* known) const {
  if (!known || !map_ || known->map_ != map_) return nullptr;
  const auto found = known->to_place_.find(place);
  return found == known->to_place_.end() ? nullptr : found->second;
}

// False if a limit struck.
bool DistanceFields::add_ports(const Instance& instance, const Limits& limits) {
  const World& world = instance.world();
  if (world.kind_count() == 1 || world.state_count() > kMostStatesWithPorts) return true;
  kinds_ = static_cast<std::size_t>(world.kind_count());
  by_port_.resize(static_cast<std::size_t>(instance.task_count()) * kinds_ * kPorts);
  const auto bytes = static_cast<std::size_t>(world.state_count()) * sizeof(Time) * kPorts;
  for (const Agent& agent : instance.agents()) {
    if (agent.kind == 0) continue;
    for (const TaskIndex task : agent.stops) {
      DistanceField* fields =
          &by_port_[(static_cast<std::size_t>(task) * kinds_ + agent.kind) * kPorts];
      if (!fields->empty()) continue;
      if (limits.stop_requested()) return false;
      if (!limits.memory_allows(bytes)) {
        limits.memory_exhausted();
        return false;
      }
      const State first = world.bases(instance.task(task).cell, agent.kind).first;
      for (int port = 0; port < kPorts; ++port) {
        std::vector<State> there;
        for (const State state : instance.states_visiting(task))
          if (world.base(state) == first + port) there.push_back(state);
        fields[port] = distance_field(world, there);
      }
    }
  }
  return true;
}

Time least_from(const World& world, Place place, int kind, const DistanceField& distance) {
  const StateRange bases = world.bases(place, kind);
  return *std::min_element(distance.begin() + bases.first, distance.begin() + bases.end);
}

Time most_from(const World& world, Place place, int kind, const DistanceField& distance) {
  const StateRange bases = world.bases(place, kind);
  return *std::max_element(distance.begin() + bases.first, distance.begin() + bases.end);
}

}  // namespace grove::detail
