// SPDX-License-Identifier: MIT
// The part of the checker (check.h) that checks one agent by itself, and what both parts use: the
// steps that a map allows, and the report of violations.
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

// The violations found so far. Ignores further ones after `limit` of them.
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

// The steps that a map allows. They are derived from its cells or roads, independently of the moves
// of its world.
class AllowedSteps {
 public:
  // `map` must outlive this.
  explicit AllowedSteps(const Map& map);

  Place places() const;
  bool is_open(Place place) const;
  bool allow(Motion motion, const Pose& from, const Pose& to) const;
  // The allowed steps, for messages.
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

// Reports every error of this agent's path against the agent's start, goal and tasks. Returns the
// time at which the agent finishes, or nullopt if its path cannot be followed.
std::optional<Time> check_agent(const Instance& instance, const AllowedSteps& steps,
                                AgentIndex index, const AgentPlan& plan, ViolationReport& report);

}  // namespace grove::detail
