// SPDX-License-Identifier: MIT
// Shortest distances that ignore other agents.
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

// Distance in steps from every state to the nearest of some target states; kNever if none is
// reachable. Indexed by State.
using DistanceField = std::vector<Time>;

// Computes the distances to the nearest of `targets` by breadth-first search backwards. O(states).
DistanceField distance_field(const World& world, std::span<const State> targets);
// The same for all states on `target`.
DistanceField distance_field(const World& world, Place target);

// A view of a distance field. The field is a DistanceField or a CompactDistanceField, which takes
// half the memory if no distance exceeds 65,534 steps.
class DistanceView {
 public:
  DistanceView() = default;  // refers to no field
  // `field` must outlive this view and must not move.
  explicit DistanceView(const DistanceField& field) : long_(field.data()) {}

  Time operator[](State state) const {
    if (!short_) return long_[state];
    const std::uint16_t steps = short_[state];
    return steps == kShortNever ? kNever : steps;
  }
  explicit operator bool() const { return short_ || long_; }
  // Compares the identity of the fields, not their content.
  friend auto operator<=>(const DistanceView&, const DistanceView&) = default;

  static constexpr std::uint16_t kShortNever = 0xFFFF;

 private:
  friend class CompactDistanceField;
  DistanceView(const std::uint16_t* in_short, const Time* in_long)
      : short_(in_short), long_(in_long) {}

  const std::uint16_t* short_ = nullptr;  // nullptr: the distances are in long_
  const Time* long_ = nullptr;
};

class CompactDistanceField {
 public:
  CompactDistanceField() = default;
  // kShortNever stands for kNever.
  explicit CompactDistanceField(std::vector<std::uint16_t> distances)
      : short_(std::move(distances)) {}
  explicit CompactDistanceField(DistanceField distances) : long_(std::move(distances)) {}
  // The caller owns the memory of `distances`, which must outlive this object.
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

// The distance fields of all targets of the agents of an instance: the tasks, and the states where
// an agent may rest. Each is computed once. Immutable: any thread may read it.
class DistanceFields {
 public:
  // Computes the fields on `threads` threads, or on one if the effort is small. Asks `limits` for
  // the memory and polls it between fields. If a limit is reached, complete() is false.
  // `known`: fields of an earlier instance, or nullptr. Fields of the same map are shared with it
  // if every state is equal to its place.
  // `arrays`: shared memory with the layout_of() this instance, or nullptr. It must outlive this
  // object. Then the fields lie there, and the other processes compute a part of them. This process
  // computes the fields that no process has provided.
  explicit DistanceFields(const Instance& instance, const Limits& limits = Limits(),
                          int threads = 1, const DistanceFields* known = nullptr,
                          const SharedArrays* arrays = nullptr);

  // The sizes in bytes of the shared arrays (ArrayKind::kDistances) for the fields of this
  // instance.
  static std::vector<std::size_t> layout_of(const Instance& instance);
  // A shared array for data that is derived from these fields. Returns no array if there are no
  // shared arrays.
  SharedArray array(ArrayKind kind, std::size_t number) const {
    return arrays_ ? arrays_->array(kind, number) : SharedArray();
  }

  // True if all fields were computed. If it is false, no field may be requested.
  bool complete() const { return complete_; }

  // Distances to the states that visit the task: those on its place or, if it takes time, the end
  // of the work.
  DistanceView to_task(TaskIndex task) const { return by_task_[task]; }
  // Distances to one port of the task: the states that visit it with an agent of kind `kind` in
  // heading `port`. Precondition: has_ports(), which is true on worlds of moderate size in which
  // agents turn.
  static constexpr int kPorts = 4;
  bool has_ports() const { return !by_port_.empty(); }
  DistanceView to_port(TaskIndex task, int kind, int port) const {
    return by_port_[(static_cast<std::size_t>(task) * kinds_ + kind) * kPorts + port];
  }
  // Distances to the states where the agent may rest. Precondition: the agent does not rest on the
  // last stop of its sequence.
  DistanceView to_rest(AgentIndex agent) const {
    GROVE_ASSERT(by_agent_[agent], "an agent that rests on its last stop has no other place");
    return by_agent_[agent];
  }

 private:
  using FieldPtr = std::shared_ptr<const CompactDistanceField>;
  FieldPtr field_to(Place place, const DistanceFields* known) const;

  const SharedArrays* arrays_ = nullptr;  // nullptr: fields_ own their memory
  std::shared_ptr<const Map> map_;        // nullptr unless every state is its place
  std::map<Place, FieldPtr> to_place_;    // fields of map_, by target
  std::vector<FieldPtr> fields_;
  std::vector<DistanceView> by_task_;
  std::vector<DistanceView> by_agent_;
  // By task, kind and heading; empty for a task that no agent of this kind has.
  std::vector<DistanceView> by_port_;
  std::size_t kinds_ = 1;
  bool complete_ = false;
};

// The minimum of the distances from the base states of one kind on a place.
Time min_distance_from(const World& world, Place place, int kind, DistanceView distances);
// The maximum of the same distances.
Time max_distance_from(const World& world, Place place, int kind, DistanceView distances);

}  // namespace grove::detail
