// SPDX-License-Identifier: MIT
// *Forward pass*, time by time. A node is a slot of safe_intervals.h (the state and everything that
// constraints require of the past), a stage of sequence_stages.h, and a time. From a node the agent
// may wait while the slot lasts, or make a move that arrives one step later. To rest is a decision,
// which is possible wherever a slot permits resting forever with no stop left. An agent that could
// rest but waits pays for the wait, as in any agent graph. Where states are places, a deadline for
// coming to rest (kRestBy) limits the cost; elsewhere the slots express it.
//
// *Claim: the paths of the graph that end at rest are exactly the paths that satisfy the
// constraints and cost `max_cost` or less.* *Proof.* A node is dropped only if its time plus its
// distance to the end exceeds `max_cost`. The costs to go are extended until they cover all
// sequences within this cost, so no stage of such a path is unknown. A path that counts each stop
// as early as possible passes all stages that matter (mdd.cpp).
//
// *Backward pass.* The earliest finish from each node is computed by descending time, because every
// move leads to a later time. So the individual cost to go from a node is exact under the
// constraints.
#include "joint/time_expanded_graphs.h"

#include <algorithm>
#include <limits>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kExpansionsPerPoll = 512;
constexpr std::size_t kMaxNumbers = std::numeric_limits<AgentGraph::Node>::max();

}  // namespace

TimeExpandedGraphs::TimeExpandedGraphs(const World& world) : world_(world), intervals_(world) {}

TimeExpandedGraphs::Outcome TimeExpandedGraphs::make(SequenceStages& goals,
                                                     std::span<const Constraint> constraints,
                                                     Time max_cost, std::size_t max_nodes,
                                                     const Limits& limits, AgentGraph& graph) {
  intervals_.assign(constraints);
  if (world_.states_are_places()) max_cost = std::min(max_cost, intervals_.latest_rest());
  graph = AgentGraph();
  graph.agent_ = goals.stops().agent();
  graph.first_move_.push_back(0);
  if (max_cost < 0 || !goals.plausible()) return Outcome::kMade;
  CostToGo& cost_to_go = goals.cost_to_go();
  if (cost_to_go.outside_bound() <= max_cost && !cost_to_go.extend(max_cost, limits))
    return limits.stop_requested() ? Outcome::kStopped : Outcome::kTooLarge;
  goals_ = &goals;
  max_cost_ = max_cost;
  // Each node and each state at rest takes a number; there are at most as many states at rest as
  // nodes.
  max_nodes = std::min(max_nodes, kMaxNumbers / 2);
  start();
  for (Index node = 0; node < std::ssize(nodes_); ++node, ++expanded_) {
    if (nodes_.size() > max_nodes) return Outcome::kTooLarge;
    if (expanded_ % kExpansionsPerPoll == 0 && limits.stop_requested()) return Outcome::kStopped;
    expand(node);
  }
  find_finishes();
  write(graph);
  return Outcome::kMade;
}

// If the start can be counted as a stop or not, there are two stages at the start, but one node.
void TimeExpandedGraphs::start() {
  nodes_.clear();
  moves_.clear();
  next_.clear();
  first_stages_.clear();
  const State state = goals_->stops().start();
  const int slot = intervals_.start_slot(state);
  const StageId first = goals_->first_stage();
  if (slot < 0 || first == SequenceStages::kOutside) return;
  goals_->on_arrival(first, state, [&](StageId stage) {
    if (goals_->distance(stage, state) <= max_cost_) first_stages_.push_back(stage);
  });
  if (!first_stages_.empty()) nodes_.push_back({slot, first, 0});
}

void TimeExpandedGraphs::expand(Index node) {
  const Timed from = nodes_[node];  // nodes_ will grow
  if (node == 0 || from.time > nodes_[node - 1].time) next_.clear();
  if (node > 0) {
    expand(from.slot, from.stage, from.time);
  } else {
    for (const StageId stage : first_stages_) expand(from.slot, stage, from.time);
  }
  nodes_[node].end_move = static_cast<Index>(moves_.size());
}

void TimeExpandedGraphs::expand(std::int32_t slot, StageId stage, Time time) {
  if (time < intervals_.end_of(slot)) reach(slot, stage, time + 1);
  intervals_.for_each_move(slot, time, [&](int next, State state, Time arrival) {
    if (arrival == time + 1)
      goals_->on_arrival(stage, state, [&](StageId then) { reach(next, then, arrival); });
  });
}

void TimeExpandedGraphs::reach(std::int32_t slot, StageId stage, Time time) {
  const auto key = static_cast<std::uint64_t>(slot) << 32 | static_cast<std::uint32_t>(stage);
  const auto [at, is_new] = next_.try_emplace(key, -1);
  if (is_new && goals_->distance(stage, intervals_.state_of(slot)) <= max_cost_ - time) {
    at->second = static_cast<Index>(nodes_.size());
    GROVE_ASSERT(nodes_.back().time <= time, "nodes are numbered in order of time");
    nodes_.push_back({slot, stage, time});
  }
  if (at->second >= 0) moves_.push_back(at->second);
}

bool TimeExpandedGraphs::may_rest(Index node) const {
  const Timed& n = nodes_[node];
  if (!intervals_.may_rest(n.slot)) return false;
  const auto rests = [&](StageId stage) {
    return goals_->is_rest(goals_->stage(stage), intervals_.state_of(n.slot));
  };
  return node > 0 ? rests(n.stage) : std::ranges::any_of(first_stages_, rests);
}

void TimeExpandedGraphs::find_finishes() {
  for (auto node = static_cast<Index>(nodes_.size()); node-- > 0;) {
    Timed& from = nodes_[node];
    if (may_rest(node)) from.finish = from.time;
    for (Index move = first_move(node); move < from.end_move; ++move)
      from.finish = std::min(from.finish, nodes_[moves_[move]].finish);
    GROVE_ASSERT(from.finish == kNever || (from.finish >= from.time && from.finish <= max_cost_),
                 "a path finishes after its nodes and within the maximum cost");
  }
}

// Omits the nodes from which the agent cannot come to rest. If the start is kept, it keeps number
// 0. Nodes at rest come last.
void TimeExpandedGraphs::write(AgentGraph& graph) const {
  using NodeId = AgentGraph::Node;
  if (nodes_.empty() || nodes_.front().finish == kNever) return;
  std::vector<NodeId> number(nodes_.size());
  NodeId count = 0;
  for (std::size_t node = 0; node < nodes_.size(); ++node)
    if (nodes_[node].finish < kNever) number[node] = count++;
  std::vector<std::pair<State, NodeId>> rests;
  const auto rest_in = [&](State state) {
    const auto known = std::ranges::find(rests, state, &std::pair<State, NodeId>::first);
    if (known != rests.end()) return known->second;
    return rests.emplace_back(state, count++).second;
  };
  const auto add = [&](State state, bool rests_there, Time to_go) {
    graph.states_.push_back(state);
    graph.places_.push_back(world_.place(state));
    graph.rests_.push_back(rests_there ? 1 : 0);
    graph.to_go_.push_back(to_go);
  };
  for (Index node = 0; node < std::ssize(nodes_); ++node) {
    const Timed& from = nodes_[node];
    if (from.finish == kNever) continue;
    const State state = intervals_.state_of(from.slot);
    add(state, false, from.finish - from.time);
    const auto first = static_cast<std::ptrdiff_t>(graph.moves_.size());
    if (may_rest(node)) graph.moves_.push_back({rest_in(state), 0});
    for (Index move = first_move(node); move < from.end_move; ++move)
      if (const Timed& to = nodes_[moves_[move]]; to.finish < kNever)
        graph.moves_.push_back({number[moves_[move]], to.finish - from.finish});
    std::ranges::sort(graph.moves_.begin() + first, graph.moves_.end(), {},
                      &AgentGraph::Move::delta_f);
    GROVE_ASSERT(std::ssize(graph.moves_) > first &&
                     graph.moves_[static_cast<std::size_t>(first)].delta_f == 0,
                 "the first move from a node begins a cheapest path");
    graph.first_move_.push_back(static_cast<std::uint32_t>(graph.moves_.size()));
  }
  for (const auto& [state, node] : rests) {
    add(state, true, 0);
    graph.moves_.push_back({node, 0});
    graph.first_move_.push_back(static_cast<std::uint32_t>(graph.moves_.size()));
  }
  GROVE_CHECK(graph.count() == count, "every kept node has one number");
}

}  // namespace grove::detail
