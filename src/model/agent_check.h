// SPDX-License-Identifier: MIT
// The part of the plan checker (check.h) that checks each agent by itself, and two types that both
// parts use: the allowed steps of a map, and the report of violations.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/check.h"

namespace grove::detail {

// Collects up to `limit` violations and ignores any further ones. One thread at a time.
class ViolationReport {
 public:
  explicit ViolationReport(std::size_t limit) : limit_(limit) {}

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

// The steps that the rules allow on a map. They are derived from its cells or roads, not from
// World::moves(), so that the check is independent of the search.
class AllowedSteps {
 public:
  // `map` must outlive this object.
  explicit AllowedSteps(const Map& map);

  Place places() const;
  bool is_open(Place place) const;
  bool allow(Motion motion, const Pose& from, const Pose& to) const;
  // Describes the allowed steps, for messages.
  std::string_view rule(Motion motion) const;
  std::string name(Place place) const;
  std::string name(Motion motion, const Pose& pose) const;

 private:
  bool lead(Place from, Place to) const;
  bool is_ahead(const Pose& from, Place to) const;
  void add_roads(const Roadmap& roadmap);

  const Map& map_;
  std::set<std::pair<Place, Place>> on_roads_;
};

// Checks the plan of agent `index` by itself, and adds its errors to `report`. Returns the agent's
// finish time. If the path is empty or contains a state that is not a base state of the agent's
// kind, adds only this error and returns nullopt. Precondition: the tasks in `plan.work` exist.
std::optional<Time> check_agent(const Instance& instance, const AllowedSteps& steps,
                                AgentIndex index, const AgentPlan& plan, ViolationReport& report);

}  // namespace grove::detail
