// SPDX-License-Identifier: MIT
// A *configuration* ("arrangement" in names) states which agent is on which place. Every step of a
// plan transforms one configuration into another by moves that the world allows; here a move counts
// as allowed in both directions if it is allowed in one. The configurations reachable from a
// configuration do not depend on headings, task execution or earlier steps. *Claim: there is no
// plan if, from the configuration of the starts (reach.h),*
// - some agent must visit a place, or has a goal, on which it is in no reachable configuration; or
// - all agents of a connected component have goals, and the configuration of these goals is not
//   reachable.
//
// *Converse.* If every step can be undone and all agents have goals, a plan exists in all other
// cases. The agents can pass, one after the other, through configurations in which they are on
// their tasks, and reach the configuration of the goals last. In between, each agent turns or
// executes its task as needed before any other agent continues.
//
// *Shortcut.* The test examines all places, so it is skipped for a connected component with enough
// room: one in which at least k + 3 places have three or more neighbours, where k is the number of
// agents. *Proof.* With m free places the component has at most k + m places. A path between
// crossings on which an agent may be stuck, or which may separate groups (reach_with_room.cpp), has
// at least m - 2 places with two neighbours. That leaves at most k + 2 others.
#include "search/pebble_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "model/assert.h"
#include "search/pebble_graph.h"
#include "search/reach.h"

namespace grove::detail {
namespace {

// Connected components of the world, explored only as far as necessary.
class Parts {
 public:
  explicit Parts(const Instance& instance)
      : world_(instance.world()),
        enough_(instance.agent_count() + 3),
        known_(static_cast<std::size_t>(world_.place_count()), Room::kUnknown) {}

  // Returns true if `place` is the first place examined of a component without enough room. In this
  // case `part` holds all places of the component.
  bool is_tight(Place place, std::vector<Place>& part) {
    part.clear();
    if (known(place) != Room::kUnknown) return false;
    const bool is_roomy = flood(place, part);
    for (const Place p : part) known(p) = is_roomy ? Room::kPlenty : Room::kTight;
    return !is_roomy;
  }

 private:
  enum class Room : std::uint8_t { kUnknown, kSeen, kPlenty, kTight };

  Room& known(Place place) { return known_[place]; }
  // Returns true as soon as there is enough room.
  bool flood(Place from, std::vector<Place>& part) {
    int crossings = 0;
    part.push_back(from);
    known(from) = Room::kSeen;
    for (std::size_t next = 0; next < part.size(); ++next) {
      if (has_three_ways(part[next]) && ++crossings >= enough_) return true;
      for (const Place p : world_.neighbors(part[next])) {
        if (known(p) == Room::kPlenty) return true;
        if (known(p) != Room::kUnknown) continue;
        known(p) = Room::kSeen;
        part.push_back(p);
      }
    }
    return false;
  }
  bool has_three_ways(Place place) const {
    return world_.neighbors(place).size() > 2 && places_around(world_, place).size() > 2;
  }

  const World& world_;
  const int enough_;
  std::vector<Room> known_;  // by place
};

// The agents of one component.
class ComponentAgents {
 public:
  ComponentAgents(const Instance& instance, std::vector<AgentIndex> agents, std::vector<Place> part,
                  Place root)
      : instance_(instance),
        agents_(std::move(agents)),
        board_(instance.world(), std::move(part), root),
        start_(static_cast<std::size_t>(board_.size()), kNoAgent) {
    for (const AgentIndex agent : agents_)
      start_[board_.node(start(instance.agent(agent)))] = agent;
    GROVE_CHECK(std::ssize(start_) - std::ranges::count(start_, kNoAgent) == std::ssize(agents_),
                "each agent of a component starts on a place of its own");
    reach_ = reach_of(board_, start_, instance.may_follow());
    GROVE_CHECK(reach_->has(start_), "the configuration of the starts is reachable");
    GROVE_CHECK(std::ranges::all_of(agents_,
                                    [&](AgentIndex agent) {
                                      const PebbleNode node =
                                          board_.node(start(instance.agent(agent)));
                                      return reach_->has(node, node);
                                    }),
                "each agent reaches its start");
  }

  std::optional<std::string> infeasibility() const {
    for (const AgentIndex agent : agents_)
      if (const auto place = out_of_reach(instance_.agent(agent)))
        return fmt::format(
            "agent '{}' cannot reach {}: the agents have too little room to let it pass",
            instance_.agent(agent).id, instance_.world().name(*place));
    if (all_have_goals() && !reach_->has(goals()))
      return "the agents cannot all reach their goals: to be there in this order they would have "
             "to "
             "pass each other, and there is too little room";
    return std::nullopt;
  }

 private:
  Place start(const Agent& agent) const { return instance_.world().place(agent.start); }

  std::optional<Place> out_of_reach(const Agent& agent) const {
    const auto is_reached = [&](Place place) {
      const PebbleNode node = board_.node(place);
      return node != PebbleGraph::kNone && reach_->has(board_.node(start(agent)), node);
    };
    for (const TaskIndex task : agent.stops)
      if (!is_reached(instance_.task(task).cell)) return instance_.task(task).cell;
    if (agent.goal && !is_reached(*agent.goal)) return agent.goal;
    return std::nullopt;
  }
  bool all_have_goals() const {
    return std::ranges::all_of(
        agents_, [&](AgentIndex agent) { return instance_.agent(agent).goal.has_value(); });
  }
  PebbleConfiguration goals() const {
    PebbleConfiguration goals(start_.size(), kNoAgent);
    for (const AgentIndex agent : agents_) goals[board_.node(*instance_.agent(agent).goal)] = agent;
    return goals;
  }

  const Instance& instance_;
  const std::vector<AgentIndex> agents_;
  const PebbleGraph board_;
  PebbleConfiguration start_;
  std::unique_ptr<ReachableConfigurations> reach_;
};

std::vector<AgentIndex> agents_by_place(const Instance& instance) {
  std::vector<AgentIndex> on(static_cast<std::size_t>(instance.world().place_count()), kNoAgent);
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent)
    on[instance.world().place(instance.agent(agent).start)] = agent;
  return on;
}

// `on`: the agent that starts on each place, or kNoAgent.
ComponentAgents agents_on(const std::vector<Place>& part, const Instance& instance,
                          const std::vector<AgentIndex>& on) {
  std::vector<AgentIndex> agents;
  Place root = part.front();
  for (const Place place : part)
    if (const AgentIndex agent = on[place]; agent != kNoAgent)
      agents.push_back(agent);
    else
      root = place;
  std::ranges::sort(agents);
  return {instance, std::move(agents), part, root};
}

}  // namespace

std::optional<std::string> pebble_motion_infeasibility(const Instance& instance) {
  Parts parts(instance);
  std::vector<Place> part;
  std::vector<AgentIndex> on;  // computed on first use
  for (const Agent& agent : instance.agents()) {
    if (!parts.is_tight(instance.world().place(agent.start), part)) continue;
    if (on.empty()) on = agents_by_place(instance);
    if (auto reason = agents_on(part, instance, on).infeasibility()) return reason;
  }
  return std::nullopt;
}

}  // namespace grove::detail
