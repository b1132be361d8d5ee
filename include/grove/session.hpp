// SPDX-License-Identifier: MIT
// An instance and its plan while time goes on and minds change.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grove/export.hpp"
#include "grove/solve.hpp"

namespace grove {

// The robot is where the plan had it so many steps ago.
struct Late {
  std::string agent = {};
  int steps = 0;
};

// What else is to be done, or no more, and what is closed.
struct Change {
  std::vector<Task> new_tasks = {};
  std::vector<std::string> dropped_tasks = {};  // ids
  std::vector<Place> blocked = {};              // cells, or vertices with all their roads
};

// Keeps the world, the distances in it and the plan from one solve to the next, which then takes
// milliseconds. One thread at a time may use it.
class GROVE_API Session {
 public:
  explicit Session(Instance instance);
  // With a valid plan of it. Throws InvalidArgument.
  Session(Instance instance, const Plan& plan);
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  // As it is now, time from 0.
  Instance instance() const;
  // A valid plan of it; none before the first replan(), after a change that concerns it, and where
  // none was found.
  std::optional<Plan> plan() const;

  // So many steps pass, by the plan, which must be there; at their end these robots are late, and
  // others perhaps for their sake. Throws InvalidArgument, and nothing has changed.
  void advance(int steps, const std::vector<Late>& late = {});

  // Throws InvalidArgument, and nothing has changed: somebody is there, or has to go there.
  void change(const Change& change);

  // Solves what is left, from the old plan repaired. All keep to the old plan, or what is left of
  // it, for `commit` steps. (Options::start is not looked at.) Throws as solve() does, and
  // InvalidArgument where a path is closed before the committed steps end.
  Solution replan(const Options& options = {}, int commit = 0);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace grove
