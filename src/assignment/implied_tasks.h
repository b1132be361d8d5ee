// SPDX-License-Identifier: MIT
// Tasks whose visits follow from the visits to another task on the same place.
#pragma once

#include <optional>
#include <vector>

#include "model/instance.h"
#include "model/plan.h"

namespace grove::detail {

// An instance without its implied tasks. It has the same agents, the same least cost, and a plan if
// and only if the whole instance has one. Proof: head of implied_tasks.cpp.
class WithoutImpliedTasks {
 public:
  // Returns nullopt if no task is implied. `whole` must outlive the result.
  static std::optional<WithoutImpliedTasks> make(const Instance& whole);

  const Instance& instance() const { return instance_; }
  // Converts a valid plan of instance() to one of the whole instance, with the same paths.
  Plan to_whole(Plan plan) const;

 private:
  struct Implied {
    TaskIndex task;
    TaskIndex by;  // the task whose visitors visit `task` as well
  };

  WithoutImpliedTasks(const Instance& whole, std::vector<Implied> implied,
                      std::vector<TaskIndex> kept);
  static std::vector<Implied> find(const Instance& whole);
  void add_visits(const Implied& implied, Plan& plan) const;

  const Instance* whole_;
  std::vector<Implied> implied_;  // in the order in which they are left out
  std::vector<TaskIndex> kept_;   // tasks of the whole instance, by index in instance_
  Instance instance_;
};

}  // namespace grove::detail
