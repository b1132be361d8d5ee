// SPDX-License-Identifier: MIT
#include "tests/oracle/arrangements.h"

#include <utility>

#include "tests/oracle/steps.h"

namespace grove::detail::oracle {
namespace {

class Walk {
 public:
  explicit Walk(const Instance& instance)
      : steps_(steps_on(instance.map())), may_follow_(instance.may_follow()) {}

  // Calls `visit` with each configuration that one joint step from `now` can lead to. `next` holds
  // the places chosen so far and is empty in the outermost call.
  template <class Visit>
  void for_each_next(const Places& now, Places& next, Visit visit) const {
    const std::size_t agent = next.size();
    if (agent == now.size()) {
      visit(next);
      return;
    }
    std::vector<Place> choices = steps_[now[agent]];
    choices.push_back(now[agent]);
    for (const Place to : choices) {
      if (!may_go(now, next, agent, to)) continue;
      next.push_back(to);
      for_each_next(now, next, visit);
      next.pop_back();
    }
  }

 private:
  bool may_go(const Places& now, const Places& next, std::size_t agent, Place to) const {
    for (std::size_t other = 0; other < now.size(); ++other) {
      if (other == agent) continue;
      if (!may_follow_ && now[other] == to) return false;
      if (other >= next.size()) continue;
      if (next[other] == to || (now[other] == to && next[other] == now[agent])) return false;
    }
    return true;
  }

  const std::vector<std::vector<Place>> steps_;
  const bool may_follow_;
};

}  // namespace

std::set<Places> reachable_configurations(const Instance& instance, std::size_t max_count) {
  Places start;
  for (const Agent& agent : instance.agents()) start.push_back(instance.world().place(agent.start));
  const Walk walk(instance);
  std::set<Places> seen{start};
  std::vector<Places> open{start};
  while (!open.empty()) {
    if (seen.size() > max_count) return {};
    const Places now = std::move(open.back());
    open.pop_back();
    Places next;
    walk.for_each_next(now, next, [&](const Places& to) {
      if (seen.insert(to).second) open.push_back(to);
    });
  }
  return seen;
}

}  // namespace grove::detail::oracle
