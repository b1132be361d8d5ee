// SPDX-License-Identifier: MIT
#include "model/distance_field.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "model/assert.h"
#include "model/thread_team.h"

namespace grove::detail {
namespace {

// With fewer field entries in total, starting threads costs more than it saves.
constexpr std::size_t kStatesForThreads = std::size_t{1} << 20;
// Worlds with more states have no fields for ports.
constexpr State kMaxStatesWithPorts = 1 << 16;

std::vector<State> states_on(const World& world, Place place) {
  std::vector<State> states;
  world.for_each_state(place, [&](State state) { states.push_back(state); });
  return states;
}

// The target sets of an instance's tasks and agents. Targets that consist of all states on one
// place share a set.
class Targets {
 public:
  explicit Targets(const Instance& instance) : instance_(instance) {
    for (TaskIndex task = 0; task < instance.task_count(); ++task)
      of_tasks.push_back(instance.task(task).duration == 0 ? on_place(instance.task(task).cell)
                                                           : add(instance.states_visiting(task)));
    for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent)
      of_agents.push_back(to_rest(agent));
    if (instance.world().kind_count() > 1 && instance.world().state_count() <= kMaxStatesWithPorts)
      add_ports();
  }

  std::vector<std::vector<State>> sets;
  std::vector<Place> places;  // by set: the place, if it contains all of its states; else kNoPlace
  // Indices in `sets`. kNone: the agent rests on its last stop, or no agent of this kind has the
  // task of this port as a stop.
  static constexpr int kNone = -1;
  std::vector<int> of_tasks;
  std::vector<int> of_agents;
  std::vector<int> of_ports;  // indexed as DistanceFields::by_port_; empty: no ports

 private:
  int add(std::vector<State> states, Place place = kNoPlace) {
    sets.push_back(std::move(states));
    places.push_back(place);
    return static_cast<int>(sets.size()) - 1;
  }
  int on_place(Place place) {
    const auto [known, is_new] = by_place_.try_emplace(place, 0);
    if (is_new) {
      known->second = add(states_on(instance_.world(), place), place);
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
  void add_ports() {
    constexpr int kPorts = DistanceFields::kPorts;
    const World& world = instance_.world();
    const auto kinds = static_cast<std::size_t>(world.kind_count());
    of_ports.assign(static_cast<std::size_t>(instance_.task_count()) * kinds * kPorts, kNone);
    for (const Agent& agent : instance_.agents()) {
      if (agent.kind == 0) continue;
      for (const TaskIndex task : agent.stops) {
        int* const ports =
            &of_ports[(static_cast<std::size_t>(task) * kinds + agent.kind) * kPorts];
        if (*ports != kNone) continue;
        const State first = world.bases(instance_.task(task).cell, agent.kind).first;
        for (int port = 0; port < kPorts; ++port) {
          std::vector<State> there;
          for (const State state : instance_.states_visiting(task))
            if (world.base(state) == first + port) there.push_back(state);
          ports[port] = add(std::move(there));
        }
      }
    }
  }

  const Instance& instance_;
  std::map<Place, int> by_place_;
  int anywhere_ = kNone;
};

// Backward breadth-first search with a reusable queue. One thread at a time.
class Walker {
 public:
  explicit Walker(const World& world)
      : world_(world), queue_(static_cast<std::size_t>(world.state_count())) {}

  DistanceField walk(std::span<const State> targets) {
    DistanceField distances(queue_.size(), kNever);
    walk(targets, kNever, distances.data());
    return distances;
  }

  // Returns nullopt if the distances do not fit in 16 bits and `limits` does not allow the memory
  // for 32-bit distances.
  std::optional<CompactDistanceField> field(std::span<const State> targets, const Limits& limits) {
    std::vector<std::uint16_t> distances(queue_.size(), DistanceView::kShortNever);
    if (walk(targets, DistanceView::kShortNever, distances.data()))
      return CompactDistanceField(std::move(distances));
    if (!limits.memory_allows(queue_.size() * sizeof(Time))) return std::nullopt;
    return CompactDistanceField(walk(targets));
  }

  // Writes the field to `distances`. Returns false if the distances do not fit in 16 bits.
  bool fill(std::span<const State> targets, std::uint16_t* distances) {
    std::fill_n(distances, queue_.size(), DistanceView::kShortNever);
    return walk(targets, DistanceView::kShortNever, distances);
  }

 private:
  // Precondition: all `distances` are equal to `never`. Returns false if a state has the distance
  // `never` - 1, so that its predecessors could not be distinguished from unreachable states.
  template <class Steps>
  bool walk(std::span<const State> targets, Steps never, Steps* distances) {
    std::size_t end = 0;
    const auto reach = [&](State state, Steps steps) {
      if (distances[state] != never) return;
      distances[state] = steps;
      queue_[end++] = state;
    };
    for (const State state : targets) reach(state, 0);
    for (std::size_t head = 0; head < end; ++head) {
      GROVE_ASSERT(head == 0 || distances[queue_[head - 1]] <= distances[queue_[head]],
                   "the distances of a breadth-first search never fall");
      const auto steps = static_cast<Steps>(distances[queue_[head]] + 1);
      if (steps == never) return false;
      for (const State before : world_.moves_to(queue_[head])) reach(before, steps);
    }
    return true;
  }

  const World& world_;
  std::vector<State> queue_;
};

}  // namespace

DistanceField distance_field(const World& world, std::span<const State> targets) {
  return Walker(world).walk(targets);
}

DistanceField distance_field(const World& world, Place target) {
  return distance_field(world, states_on(world, target));
}

std::vector<std::size_t> DistanceFields::layout_of(const Instance& instance) {
  const auto states = static_cast<std::size_t>(instance.world().state_count());
  return std::vector<std::size_t>(Targets(instance).sets.size(), states * sizeof(std::uint16_t));
}

DistanceFields::DistanceFields(const Instance& instance, const Limits& limits, int threads,
                               const DistanceFields* known, const SharedArrays* arrays)
    : arrays_(arrays) {
  if (instance.world().states_are_places()) map_ = instance.shared_map();
  const Targets targets(instance);
  const std::size_t sets = targets.sets.size();
  const auto states = static_cast<std::size_t>(instance.world().state_count());
  // The memory of shared arrays is already allocated.
  if (!limits.memory_allows(arrays ? 0 : sets * states * sizeof(std::uint16_t))) {
    limits.memory_exhausted();
    return;
  }
  for (const Place place : targets.places) fields_.push_back(field_to(place, known));
  if (sets * states < kStatesForThreads) threads = 1;
  ThreadTeam team(threads);
  std::atomic<std::size_t> next{0};
  if (arrays)
    team.run([&](int) {
      Walker walker(instance.world());
      for (std::size_t i = next++; i < sets && !limits.stop_requested(); i = next++) {
        const std::size_t set = (arrays->first_of(sets) + i) % sets;
        if (!fields_[set])
          array(ArrayKind::kDistances, set).make([&](std::byte* begin) {
            return walker.fill(targets.sets[set], reinterpret_cast<std::uint16_t*>(begin));
          });
      }
    });
  next = 0;
  team.run([&](int) {
    Walker walker(instance.world());
    for (std::size_t set = next++; set < sets; set = next++) {
      if (fields_[set]) continue;
      if (limits.stop_requested()) return;
      if (const std::byte* made = array(ArrayKind::kDistances, set).await(limits)) {
        fields_[set] = std::make_shared<const CompactDistanceField>(
            reinterpret_cast<const std::uint16_t*>(made));
        continue;
      }
      auto field = walker.field(targets.sets[set], limits);
      if (!field) return limits.memory_exhausted();
      fields_[set] = std::make_shared<const CompactDistanceField>(std::move(*field));
    }
  });
  if (std::ranges::count(fields_, nullptr) > 0) return;
  for (std::size_t set = 0; set < sets; ++set)
    if (map_ && targets.places[set] != kNoPlace)
      to_place_.emplace(targets.places[set], fields_[set]);
  const auto distances = [&](int set) {
    return set == Targets::kNone ? DistanceView() : fields_[set]->distances();
  };
  for (const int set : targets.of_tasks) by_task_.push_back(distances(set));
  for (const int set : targets.of_agents) by_agent_.push_back(distances(set));
  for (const int set : targets.of_ports) by_port_.push_back(distances(set));
  kinds_ = static_cast<std::size_t>(instance.world().kind_count());
  GROVE_CHECK(std::ranges::none_of(by_task_, [](DistanceView view) { return !view; }),
              "each task has a distance field");
  complete_ = true;
}

DistanceFields::FieldPtr DistanceFields::field_to(Place place, const DistanceFields* known) const {
  if (!known || !map_ || known->map_ != map_) return nullptr;
  const auto found = known->to_place_.find(place);
  return found == known->to_place_.end() ? nullptr : found->second;
}

Time min_distance_from(const World& world, Place place, int kind, DistanceView distances) {
  const StateRange bases = world.bases(place, kind);
  Time least = distances[bases.first];
  for (State s = bases.first + 1; s < bases.end; ++s) least = std::min(least, distances[s]);
  return least;
}

Time max_distance_from(const World& world, Place place, int kind, DistanceView distances) {
  const StateRange bases = world.bases(place, kind);
  Time most = distances[bases.first];
  for (State s = bases.first + 1; s < bases.end; ++s) most = std::max(most, distances[s]);
  return most;
}

}  // namespace grove::detail
