// SPDX-License-Identifier: MIT
// Distance fields: shortest distances of one agent to its targets, without regard to other agents.
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

// By State: the distance in steps to the nearest of some target states; kNever if none is
// reachable.
using DistanceField = std::vector<Time>;

// Computes the distances to the nearest of `targets` by backward breadth-first search. O(states +
// moves).
DistanceField distance_field(const World& world, std::span<const State> targets);
// Computes the distances to the nearest state on place `target`.
DistanceField distance_field(const World& world, Place target);

// Read access to a distance field without ownership. The field is a DistanceField or a
// CompactDistanceField.
class DistanceView {
 public:
  DistanceView() = default;  // views no field
  // `field` must outlive this view and must not be resized.
  explicit DistanceView(const DistanceField& field) : long_(field.data()) {}

  Time operator[](State state) const {
    if (!short_) return long_[state];
    const std::uint16_t steps = short_[state];
    return steps == kShortNever ? kNever : steps;
  }
  explicit operator bool() const { return short_ || long_; }
  // Compares the addresses of the fields, not their entries.
  friend auto operator<=>(const DistanceView&, const DistanceView&) = default;

  static constexpr std::uint16_t kShortNever = 0xFFFF;

 private:
  friend class CompactDistanceField;
  DistanceView(const std::uint16_t* in_short, const Time* in_long)
      : short_(in_short), long_(in_long) {}

  const std::uint16_t* short_ = nullptr;  // nullptr: the distances are in long_
  const Time* long_ = nullptr;
};

// A distance field with 16-bit distances, which take half the memory of a DistanceField, or with
// the distances of a DistanceField.
class CompactDistanceField {
 public:
  CompactDistanceField() = default;
  // 16-bit distances, in which kShortNever stands for kNever.
  explicit CompactDistanceField(std::vector<std::uint16_t> distances)
      : short_(std::move(distances)) {}
  explicit CompactDistanceField(DistanceField distances) : long_(std::move(distances)) {}
  // Refers to 16-bit distances that the caller owns. They must outlive this object.
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

// The distance fields of an instance: for each task, for the states in which each agent may rest
// (unless it rests on its last stop) and, if has_ports(), for each port of a stop. Targets that
// consist of all states on one place share a field, and so do all idle agents. Immutable: any
// thread may read it.
class DistanceFields {
 public:
  // Computes the fields on `threads` threads, or on one thread if the effort is small. Checks the
  // memory limit first, and polls `limits` before each field. If a limit is reached before all
  // fields are computed, complete() is false. Calls limits.memory_exhausted() if the fields need
  // too much memory.
  // `known`: fields of an earlier instance, or nullptr. If both instances share the map object and
  // every state is equal to its place, fields of common target places are reused.
  // `arrays`: shared arrays with layout_of(instance), or nullptr. They must outlive this object.
  // With `arrays` the fields are stored there, and each process computes a part of them. This
  // process computes in its own memory each field that no process has completed.
  explicit DistanceFields(const Instance& instance, const Limits& limits = Limits(),
                          int threads = 1, const DistanceFields* known = nullptr,
                          const SharedArrays* arrays = nullptr);

  // The size in bytes of each shared array (ArrayKind::kDistances) for the fields of `instance`.
  static std::vector<std::size_t> layout_of(const Instance& instance);
  // A shared array for data that is derived from these fields. The result refers to no array if
  // this object does not use shared arrays or their layout does not contain it.
  SharedArray array(ArrayKind kind, std::size_t number) const {
    return arrays_ ? arrays_->array(kind, number) : SharedArray();
  }

  // True if all fields were computed. Only then may the functions below be called.
  bool complete() const { return complete_; }

  // Distances to the states in which an agent visits the task: all states on its place or, if the
  // task takes time, the states in which its execution is completed.
  DistanceView to_task(TaskIndex task) const { return by_task_[task]; }
  // The number of ports of a task, one for each heading.
  static constexpr int kPorts = 4;
  // True on worlds of moderate size with tasks and with agents whose turns take time.
  bool has_ports() const { return !by_port_.empty(); }
  // Distances to one port of the task: the states in which an agent of kind `kind` visits it with
  // heading `port`. Preconditions: has_ports(), and the task is a stop of an agent of this kind.
  DistanceView to_port(TaskIndex task, int kind, int port) const {
    const DistanceView view =
        by_port_[(static_cast<std::size_t>(task) * kinds_ + kind) * kPorts + port];
    GROVE_ASSERT(view, "a port belongs to a stop of an agent of its kind");
    return view;
  }
  // Distances to the states where the agent may rest. Precondition: the agent does not rest on the
  // last stop of its sequence.
  DistanceView to_rest(AgentIndex agent) const {
    GROVE_ASSERT(by_agent_[agent],
                 "an agent that rests on its last stop has no other place of rest");
    return by_agent_[agent];
  }

 private:
  using FieldPtr = std::shared_ptr<const CompactDistanceField>;
  FieldPtr field_to(Place place, const DistanceFields* known) const;

  const SharedArrays* arrays_ = nullptr;  // nullptr: no shared arrays are used
  std::shared_ptr<const Map> map_;        // nullptr unless every state is equal to its place
  std::map<Place, FieldPtr> to_place_;    // by target place: fields that depend only on map_
  std::vector<FieldPtr> fields_;
  std::vector<DistanceView> by_task_;
  std::vector<DistanceView> by_agent_;
  // By task, kind and heading; an empty view if no agent of this kind has the task as a stop.
  std::vector<DistanceView> by_port_;
  std::size_t kinds_ = 1;
  bool complete_ = false;
};

// The minimum distance over the base states of kind `kind` on `place`.
Time min_distance_from(const World& world, Place place, int kind, DistanceView distances);
// The maximum distance over the base states of kind `kind` on `place`.
Time max_distance_from(const World& world, Place place, int kind, DistanceView distances);

}  // namespace grove::detail
