// SPDX-License-Identifier: MIT
// Leg planner of HCBS (Surynek, AAAI 2021): one space-time A* per leg.
#pragma once

#include <cstdint>
#include <vector>

#include "baselines/legs.h"
#include "planning/bucket_queue.h"

namespace grove::detail {

class SpaceTimeLegs : public Legs {
 public:
  // `world` must outlive this object.
  explicit SpaceTimeLegs(const World& world) : world_(world) {}

  void begin(const AgentStops& stops, const SafeIntervals& intervals,
             std::span<const Constraint> constraints) override;
  Time arrival(Cell from, Time time, Target target, const Limits& limits) override;
  void append(Cell from, Time time, Target target, Path& path) override;
  std::int64_t expanded() const override { return expanded_; }

 private:
  struct Label {
    Time time = 0;
    std::int32_t parent = -1;
    std::uint32_t stamp = 0;
  };

  std::int32_t find(Cell from, Time time, Target target, const Limits& limits);
  void reach(Cell cell, Time time, std::int32_t parent, Target target);
  void forget();
  Time distance(Cell cell, int goal) const;
  std::int32_t id_of(Cell cell, Time time) const {
    return (std::min(time, static_from_) - first_) * world_.place_count() + cell;
  }
  Cell cell_of(std::int32_t id) const { return id % world_.place_count(); }

  const World& world_;
  BucketQueue queue_;
  std::int64_t expanded_ = 0;

  // Set by begin().
  const AgentStops* stops_ = nullptr;
  const SafeIntervals* intervals_ = nullptr;
  Time static_from_ = 0;

  // State of the leg in progress.
  Time first_ = 0;             // time of the first row
  std::vector<Label> labels_;  // by time - first_, then cell; the last row stands for all
                               // times from static_from_ on
  std::uint32_t stamp_ = 0;
};

}  // namespace grove::detail
