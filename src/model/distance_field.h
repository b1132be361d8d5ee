// SPDX-License-Identifier: MIT
// Shortest distances, ignoring other agents.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "model/assert.h"
#include "model/instance.h"
#include "model/limits.h"
#include "model/shared_arrays.h"

namespace grove::detail {

// Distance in steps from every state to one of some states; kNever where none can be reached.
// Indexed by State.
using DistanceField = std::vector<Time>;

// Breadth-first search backwards from all of `targets`. O(states).
DistanceField distance_field(const World& world, std::span<const State> targets);
// From all states on `target`.
DistanceField distance_field(const World& world, Place target);

// A distance field as it is kept, in half the memory where nothing is further than 65,534 steps. A
// view of what a CompactDistanceField holds.
class DistanceView {
 public:
  DistanceView() = default;  // none
  // Of a field that stays where it is.
  explicit DistanceView(const DistanceField& field) : long_(field.data()) {}

  Time operator[](State state) const {
    if (!short_) return long_[state];
    const std::uint16_t steps = short_[state];
    return steps == kShortNever ? kNever : steps;
  }
  explicit operator bool() const { return short_ || long_; }
  // By which field it is, not by what is in it.
  friend auto operator<=>(const DistanceView&, const DistanceView&) = default;

  static constexpr std::uint16_t kShortNever = 0xFFFF;

 private:
  friend class CompactDistanceField;
  DistanceView(const std::uint16_t* in_short, const Time* in_long)
      : short_(in_short), long_(in_long) {}

  const std::uint16_t* short_ = nullptr;  // null: they are in long_
  const Time* long_ = nullptr;
};

class CompactDistanceField {
 public:
  CompactDistanceField() = default;
  // kShortNever stands for kNever.
  explicit CompactDistanceField(std::vector<std::uint16_t> distances)
      : short_(std::move(distances)) {}
  explicit CompactDistanceField(DistanceField distances) : long_(std::move(distances)) {}
  // In memory that somebody else owns, and that must outlive this.
  explicit CompactDistanceField(const std::uint16_t* distances) : elsewhere_(distances) {}

  DistanceView distances() const {
    if (elsewhere_) return {elsewhere_, nullptr};
    return {short_.empty() ? nullptr : short_.data(), long_.empty() ? nullptr : long_.data()};
  }

 private:
  const std::uint16_t* elsewhere_ = nullptr;
  std::vector<std::uint16_t> short_;
  DistanceField long_;
};

// The fields of all that any agent of an instance must reach: its tasks, and where to rest. Each
// is computed once. Immutable after construction; any thread may read it.
class DistanceFields {
 public:
  // Computes them on so many threads, if there is enough to do. Asks `limits` for the memory and
  // looks at them between fields; if they strike, complete() is false. Shares what `known` (null:
  // nothing) has of the same map, as long as every state is its place. Fields lie in `arrays`, if
  // there are some (of the layout_of() this instance; they must outlive this), where other
  // processes make their share of them; what nobody there makes is made here.
  explicit DistanceFields(const Instance& instance, const Limits& limits = Limits(),
                          int threads = 1, const DistanceFields* known = nullptr,
                          const SharedArrays* arrays = nullptr);

  // The arrays that fields of this instance take when they are shared, of ArrayKind::kDistances: so
  // many bytes each.
  static std::vector<std::size_t> layout_of(const Instance& instance);
  // An array for what is derived from these fields; none unless there are shared ones.
  SharedArray array(ArrayKind kind, std::size_t number) const {
    return arrays_ ? arrays_->array(kind, number) : SharedArray();
  }

  // All fields are there. If not, nothing must be asked for.
  bool complete() const { return complete_; }

  // To where the task is visited: a state on its place or, if it takes time, the end of the work.
  DistanceView to_task(TaskIndex task) const { return by_task_[task]; }
  // The same in one heading, a port: the agent of that kind is there, or has done the work, looking
  // that way. Only if there are such fields: on worlds of moderate size in which agents turn.
  static constexpr int kPorts = 4;
  bool has_ports() const { return !by_port_.empty(); }
  DistanceView to_port(TaskIndex task, int kind, int port) const {
    return by_port_[(static_cast<std::size_t>(task) * kinds_ + kind) * kPorts + port];
  }
  // To where the agent may rest. Not of agents that rest on the last stop of their sequence.
  DistanceView to_rest(AgentIndex agent) const {
    GROVE_ASSERT(by_agent_[agent], "an agent that rests on its last stop has no other place");
    return by_agent_[agent];
  }

 private:
  using FieldPtr = std::shared_ptr<const CompactDistanceField>;
  FieldPtr field_to(Place place, const DistanceFields* known) const;

  const SharedArrays* arrays_ = nullptr;  // null: fields_ own their memory
  std::shared_ptr<const Map> map_;        // null unless every state is its place
  std::map<Place, FieldPtr> to_place_;    // of that map
  std::vector<FieldPtr> fields_;
  std::vector<DistanceView> by_task_;
  std::vector<DistanceView> by_agent_;
  // By task, kind and heading; empty where no such agent has the task.
  std::vector<DistanceView> by_port_;
  std::size_t kinds_ = 1;
  bool complete_ = false;
};

// The least of the distances from the base states of one kind on a place.
Time least_from(const World& world, Place place, int kind, DistanceView distances);
// The greatest.
Time most_from(const World& world, Place place, int kind, DistanceView distances);

}  // namespace grove::detail
