// SPDX-License-Identifier: MIT
// MDD of one agent for a range of costs: its paths that cost at most the least cost plus some
// excess.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "model/limits.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// Layered graph over (state, stage, time), of an agent without constraints. A node is either *on
// the way*, or *arrived*: the agent has made its last arrival on the place and stays there forever.
// A walk from a start to a final node is a path; its cost is the time of the final node, plus the
// price of resting there (AgentStops). Every path that does not wait after its last arrival is a
// walk. The excess of a node is the least cost of a walk through it, minus the least cost of all
// walks. Grows on demand; node numbers do not change. One thread at a time.
class PathGraph {
 public:
  using Node = std::int32_t;
  static constexpr Time kOnTheWay = -1;

  enum class Outcome : std::uint8_t {
    kGrown,
    kGrowing,   // `max_visits` was reached
    kTooLarge,  // more than `max_nodes` nodes, or the costs to go would become too large
    kStopped,   // a limit was reached
  };

  // `least_cost`: the agent's least cost, or a lower bound. `stops` must outlive this object.
  PathGraph(AgentStops& stops, Time least_cost);

  // Adds all nodes with excess <= `excess`, and visits at most `max_visits` nodes. After kGrowing,
  // call it again with the same arguments; until it returns kGrown, use only grown() and visited().
  // After kTooLarge and kStopped, the graph must not be used any more.
  Outcome grow(Time excess, std::size_t max_visits, std::size_t max_nodes, const Limits& limits);
  // The greatest excess to which the graph has grown; -1: none.
  Time grown() const { return grown_; }

  Time least_cost() const { return least_cost_; }
  // Is there a walk of the least cost? Precondition: the graph has grown.
  bool has_least_cost() const {
    return std::ranges::any_of(starts_, [&](Node start) { return nodes_[start].excess == 0; });
  }
  // Number of nodes. Some of them may have an excess above the greatest value for which the graph
  // was grown, or kNever.
  Node count() const { return static_cast<Node>(nodes_.size()); }
  State state(Node node) const { return nodes_[node].state; }
  Place place(Node node) const { return world_.place(nodes_[node].state); }
  Time time(Node node) const { return nodes_[node].time; }
  // The time of the last arrival on the place; kOnTheWay if the agent will leave the place.
  Time arrival(Node node) const { return nodes_[node].arrival; }
  Time excess(Node node) const { return nodes_[node].excess; }
  // A final node has no successors.
  bool is_final(Node node) const { return nodes_[node].is_final; }
  // The stops that the agent has not counted.
  StopSet stops_left(Node node) const { return left_of_stages_[nodes_[node].stage]; }
  StopSet all_stops() const { return goals_.stops().all(); }
  bool has_prices() const { return goals_.stops().has_prices(); }
  TaskIndex task_of(int stop) const {
    const AgentStops& stops = goals_.stops();
    return stops.instance().agent(stops.agent()).stops[static_cast<std::size_t>(stop)];
  }
  // True if no two nodes have the same place, time and arrival.
  bool has_one_node_per_presence() const {
    return world_.kind(goals_.stops().start()) == 0 && goals_.stops().count() == 0;
  }
  // What distinguishes a node from the others with the same place, time and arrival.
  struct Position {
    std::int32_t pose;   // rank among the base states of the agent's kind on the place
    StopSet stops_done;  // by index in Agent::stops
    int stop;            // whose task is being executed or was just completed; -1: none
    Time steps_done;     // of this execution
  };
  Position position(Node node) const;
  std::span<const Node> starts() const { return starts_; }
  std::span<const Node> successors(Node node) const {
    return {successors_.data() + nodes_[node].first, successors_.data() + nodes_[node].end};
  }

  // True if every walk through the node continues with one of successors(), whatever its cost, and
  // all of these have an excess of at most the greatest value for which the graph was grown.
  bool has_all_successors(Node node) const { return nodes_[node].has_all_successors; }

  // Nodes visited by all calls of grow().
  std::int64_t visited() const { return visited_; }
  std::size_t bytes() const;

 private:
  using StageId = SequenceStages::StageId;

  // Identifies a node over all calls of grow(). Stages are renumbered when the costs to go are
  // extended, therefore `stage` is a number of stage_numbers_.
  struct Key {
    State state;
    std::int32_t stage;
    Time time;
    Time arrival;
    bool is_final;
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const;
  };
  struct Data {
    State state;
    std::int32_t stage;  // as Key::stage
    Time time;
    Time arrival;
    Time price = 0;  // of a final node
    Time excess = kNever;
    std::int32_t first = 0;  // range in successors_
    std::int32_t end = 0;
    bool is_final = false;
    bool has_all_successors = false;
  };

  void start();
  void expand(Node node, StageId stage);
  // Returns false if the node might be added by a later call of grow().
  bool reach(State state, StageId stage, Time time, Time arrival);
  bool may_continue(State state, StageId stage, Time arrival) const;
  void add(State state, StageId stage, Time time, Time arrival, Time price);
  bool is_executing(State state) const;
  bool is_foreign_work(State state) const;
  std::int32_t stage_number(StageId stage);
  void find_excesses();

  const World& world_;
  SequenceStages goals_;
  const Time least_cost_;
  std::vector<Data> nodes_;
  std::vector<Node> starts_;
  std::vector<Node> successors_;
  std::unordered_map<Key, Node, KeyHash> numbers_;
  std::map<std::pair<StopSet, StopSet>, std::int32_t> stage_numbers_;  // by Stage::left and ::rests
  std::vector<StopSet> left_of_stages_;                                // by stage number
  std::int64_t visited_ = 0;
  Time grown_ = -1;
  // Of the current growth.
  bool is_growing_ = false;
  Time latest_ = 0;
  std::vector<std::pair<Node, StageId>> queue_;  // in order of time
  std::size_t expanded_ = 0;                     // of queue_
  std::vector<std::uint8_t> is_queued_;          // by node
  std::vector<std::int32_t> numbers_of_stages_;  // by StageId; -1: not known yet
};

}  // namespace grove::detail
