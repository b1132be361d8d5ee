// SPDX-License-Identifier: MIT
// The neighbourhoods of large neighbourhood search over routes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "assignment/routes.h"
#include "model/instance.h"
#include "model/omega.h"
#include "model/random.h"

namespace grove::detail {

// Slack induction by string removals (Christiaens and Vanden Berghe 2020): removes strings of
// successive visits from adjacent routes, and inserts them again, in the same routes or others. One
// thread at a time.
class StringRemoval {
 public:
  struct Size {
    int longest = 25;  // greatest number of visits that are removed from one route
    int mean = 12;     // mean number of visits that are removed from all routes, about
  };
  // A route before the change.
  struct Saved {
    AgentIndex agent;
    std::vector<TaskIndex> stops;
  };

  // `routes` and `random` must outlive this object. If anything else changes the stops of routes,
  // call begin() before apply().
  StringRemoval(Routes& routes, Random& random, Size size);

  // False if no agent visits a task.
  bool is_possible() const { return !tasks_.empty(); }
  // Starts with the current routes.
  void begin();
  // Changes the routes. Returns the change of their total cost, or nullopt if a visit could not be
  // inserted; the routes are then as before. Precondition: is_possible().
  std::optional<Cost> apply();
  // The former routes of the agents that the last apply() changed. Some may be the same as before.
  const std::vector<Saved>& changed() const { return saved_; }
  // Undoes the last apply(), which must have succeeded.
  void undo();

  std::int64_t insertions() const { return insertions_; }  // into a route, that were tried

 private:
  // A visit of `agent`; kAny: of any agent of the task.
  struct Visit {
    TaskIndex task;
    AgentIndex agent;
  };
  static constexpr AgentIndex kAny = -1;

  void find_neighbors();
  Cost remove_strings();
  Cost remove_string(AgentIndex agent, TaskIndex task, int longest);
  void order_removed();
  std::optional<Time> insert(const Visit& visit);
  bool is_saved(AgentIndex agent) const;
  void save(AgentIndex agent);

  Routes& routes_;
  const Instance& instance_;
  Random& random_;
  const Size size_;
  std::vector<std::vector<TaskIndex>> neighbors_;  // by task, the nearest first, with itself
  std::vector<TaskIndex> tasks_;                   // with visits
  std::vector<std::vector<AgentIndex>> visitors_;  // by task
  std::vector<Saved> saved_;
  std::vector<Visit> removed_;
  std::int64_t insertions_ = 0;
};

}  // namespace grove::detail
