// SPDX-License-Identifier: MIT
#include "visitors_first.h"

#include <unordered_map>

namespace grove::detail {
namespace {

class Sorter {
 public:
  explicit Sorter(const Instance& instance)
      : visitors_(static_cast<std::size_t>(instance.agent_count())),
        seen_(visitors_.size(), false) {
    std::unordered_map<Place, AgentIndex> owners;  // of destinations
    for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent)
      if (const auto goal = instance.agent(agent).goal) owners.emplace(*goal, agent);
    for (const Task& task : instance.tasks())
      if (const auto owner = owners.find(task.cell); owner != owners.end())
        visitors_[owner->second].insert(visitors_[owner->second].end(), task.agents.begin(),
                                        task.agents.end());
  }

  // Depth first, with a stack of our own: chains may be long.
  void add(AgentIndex agent) {
    enter(agent);
    while (!open_.empty()) {
      auto& [last, next] = open_.back();
      if (next < visitors_[last].size()) {
        enter(visitors_[last][next++]);
      } else {
        sorted_.push_back(last);
        open_.pop_back();
      }
    }
  }
  std::vector<AgentIndex> take() { return std::move(sorted_); }

 private:
  struct Open {
    AgentIndex agent;
    std::size_t next;  // of its visitors
  };

  void enter(AgentIndex agent) {
    if (seen_[agent]) return;
    seen_[agent] = true;
    open_.push_back({agent, 0});
  }

  std::vector<std::vector<AgentIndex>> visitors_;  // of an agent's destination
  std::vector<bool> seen_;
  std::vector<Open> open_;
  std::vector<AgentIndex> sorted_;
};

}  // namespace

std::vector<AgentIndex> visitors_first(const Instance& instance,
                                       std::span<const AgentIndex> order) {
  Sorter sorter(instance);
  for (const AgentIndex agent : order) sorter.add(agent);
  return sorter.take();
}

}  // namespace grove::detail
