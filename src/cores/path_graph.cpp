// SPDX-License-Identifier: MIT
// *Forward pass*, time by time, from the start. An agent on the way waits or moves; when it enters
// a place, it can also have arrived there for good, and then only turns or executes tasks on the
// place. Of the arrived agents those in a state of rest are final.
//
// *Claim: for each path of cost least_cost + excess or less there is a walk with the same places,
// the same time of the last arrival, and at most the same cost.* *Proof.* Split the path at its
// last arrival. Before it, the path is a walk on the way: grow() extends the costs to go until they
// cover all sequences within the cost, and a path that counts each stop as early as possible passes
// only known stages (mdd.cpp; with prices: that counts its set of stops as early as possible).
// After it, waits are pointless: without them the agent is on the same place at the same times,
// forever, does the same tasks, and finishes no later. For the same reason an agent that may rest
// does nothing more, unless it can execute a task on the place. A node is dropped only if its time
// plus a lower bound on the remaining cost exceeds the cost.
//
// *All successors.* The costs to go cover all routes of cost latest_ or less, so if time + distance
// <= latest_, no unknown route is shorter, and the distance is a lower bound at all later calls
// too. A node has all its successors if no move from it was dropped because of its cost; an arrival
// is dropped for good where even this lower bound shows that the agent must leave the place again.
//
// *Backward pass.* Moves lead to later times, so the least cost from each node is computed by
// descending time.
#include "cores/path_graph.h"

#include <algorithm>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::size_t kNodesPerPoll = 1024;

}  // namespace

std::size_t PathGraph::KeyHash::operator()(const Key& key) const {
  std::uint64_t hash = static_cast<std::uint32_t>(key.state) * 0x9e3779b97f4a7c15ULL;
  hash ^= static_cast<std::uint32_t>(key.time) * 0xc2b2ae3d27d4eb4fULL;
  hash ^= static_cast<std::uint32_t>(key.stage) * 0x165667b19e3779f9ULL;
  hash ^= static_cast<std::uint32_t>(2 * (key.arrival + 1) + (key.is_final ? 1 : 0)) *
          0xd6e8feb86659fd93ULL;
  return hash ^ hash >> 29;
}

PathGraph::PathGraph(AgentStops& stops, Time least_cost)
    : world_(stops.instance().world()), goals_(stops, SequenceClass{}), least_cost_(least_cost) {}

PathGraph::Outcome PathGraph::grow(Time excess, std::size_t max_visits, std::size_t max_nodes,
                                   const Limits& limits) {
  latest_ = least_cost_ + excess;
  if (!is_growing_) {
    CostToGo& cost_to_go = goals_.cost_to_go();
    if (cost_to_go.outside_bound() <= latest_ && !cost_to_go.extend(latest_, limits))
      return limits.stop_requested() ? Outcome::kStopped : Outcome::kTooLarge;
    start();
  }
  for (; expanded_ < queue_.size(); ++expanded_) {
    if (max_visits-- == 0) return Outcome::kGrowing;
    if (nodes_.size() > max_nodes) return Outcome::kTooLarge;
    if (expanded_ % kNodesPerPoll == 0 && limits.stop_requested()) return Outcome::kStopped;
    const auto [node, stage] = queue_[expanded_];
    nodes_[node].first = static_cast<std::int32_t>(successors_.size());
    expand(node, stage);
    nodes_[node].end = static_cast<std::int32_t>(successors_.size());
    ++visited_;
  }
  find_excesses();
  queue_ = {};
  is_growing_ = false;
  grown_ = excess;
  return Outcome::kGrown;
}

void PathGraph::start() {
  is_growing_ = true;
  queue_.clear();
  expanded_ = 0;
  is_queued_.assign(nodes_.size(), 0);
  numbers_of_stages_.clear();
  successors_.clear();
  const StageId first = goals_.first_stage();
  GROVE_CHECK(first != SequenceStages::kOutside, "an agent with a path has a first stage");
  const State state = goals_.stops().start();
  goals_.on_arrival(first, state, [&](StageId stage) {
    reach(state, stage, 0, kOnTheWay);
    reach(state, stage, 0, 0);
  });
  starts_ = std::exchange(successors_, {});
}

void PathGraph::expand(Node node, StageId stage) {
  const Data from = nodes_[node];  // nodes_ will grow
  if (from.is_final) return;
  const Time then = from.time + 1;
  const bool on_the_way = from.arrival == kOnTheWay;
  bool all = true;
  if (on_the_way && !is_executing(from.state)) all = reach(from.state, stage, then, kOnTheWay);
  for (const State state : world_.moves(from.state)) {
    const bool enters = world_.place(state) != world_.place(from.state);
    if ((!on_the_way && enters) || is_foreign_work(state)) continue;
    const bool known = goals_.on_arrival(stage, state, [&](StageId next) {
      all &= reach(state, next, then, from.arrival);
      if (enters) all &= reach(state, next, then, then);
    });
    all &= known;
  }
  nodes_[node].has_all_successors = all;
}

// True within a task execution, which has no breaks.
bool PathGraph::is_executing(State state) const {
  return world_.is_working(state) && !world_.work(state).completed;
}

// Another agent's task has the same effect as a wait, but no plan may contain it. (Where the agent
// has a stop on the place, on_arrival() does not refuse these states.)
bool PathGraph::is_foreign_work(State state) const {
  if (!world_.is_working(state)) return false;
  const AgentStops& stops = goals_.stops();
  const std::vector<TaskIndex>& own = stops.instance().agent(stops.agent()).stops;
  return std::ranges::find(own, world_.work(state).task) == own.end();
}

bool PathGraph::reach(State state, StageId stage, Time time, Time arrival) {
  const Time distance = goals_.distance(stage, state);
  if (distance > latest_ - time) return false;
  const Time price =
      arrival == kOnTheWay ? kNever : goals_.price_of_rest(goals_.stage(stage), state);
  const bool is_within = price <= latest_ - time;
  if (is_within) add(state, stage, time, arrival, price);
  if (may_continue(state, stage, arrival)) add(state, stage, time, arrival, kNever);
  return is_within || price >= kNever;
}

// Can the agent do more before it comes to rest? An arrived agent leaves the place no more. No
// unknown route is shorter than the distance, so later calls of grow() come to the same result.
// (With prices, the distance does not state how long the agent stays.)
bool PathGraph::may_continue(State state, StageId stage, Time arrival) const {
  if (arrival == kOnTheWay) return true;
  const AgentStops& stops = goals_.stops();
  const SequenceStages::Stage& s = goals_.stage(stage);
  if (!stops.has_prices())
    return goals_.price_of_rest(s, state) >= kNever &&
           goals_.distance(stage, state) <= stops.longest_finish(world_.place(state));
  bool has_task = false;
  for_each_stop(s.next, [&](int stop) {
    has_task |= stops.takes_time(stop) && stops.place(stop) == world_.place(state);
  });
  return has_task || (s.price < kNever && goals_.price_of_rest(s, state) >= kNever &&
                      stops.may_turn_to_rest(state));
}

// Adds a node, final if `price` is not kNever, and makes it a successor of the current one.
void PathGraph::add(State state, StageId stage, Time time, Time arrival, Time price) {
  const std::int32_t number = stage_number(stage);
  const bool is_final = price < kNever;
  const auto [at, is_new] = numbers_.try_emplace({state, number, time, arrival, is_final}, count());
  const Node node = at->second;
  if (is_new) {
    nodes_.push_back({.state = state,
                      .stage = number,
                      .time = time,
                      .arrival = arrival,
                      .price = is_final ? price : 0,
                      .is_final = is_final});
    is_queued_.push_back(0);
  }
  if (is_queued_[node] == 0) {
    is_queued_[node] = 1;
    queue_.emplace_back(node, stage);
  }
  successors_.push_back(node);
}

std::int32_t PathGraph::stage_number(StageId stage) {
  const auto index = static_cast<std::size_t>(stage);
  if (index >= numbers_of_stages_.size()) numbers_of_stages_.resize(index + 1, -1);
  std::int32_t& number = numbers_of_stages_[index];
  if (number < 0) {
    const SequenceStages::Stage& key = goals_.stage(stage);
    const auto [known, is_new] = stage_numbers_.try_emplace(
        {key.left, key.rests}, static_cast<std::int32_t>(stage_numbers_.size()));
    if (is_new) left_of_stages_.push_back(key.left);
    number = known->second;
  }
  return number;
}

PathGraph::Position PathGraph::position(Node node) const {
  const AgentStops& stops = goals_.stops();
  const State state = nodes_[node].state;
  const State base = world_.base(state);
  Position position{base - world_.bases(world_.place(base), world_.kind(base)).first,
                    stops.all() & ~left_of_stages_[nodes_[node].stage], -1, 0};
  if (!world_.is_working(state)) return position;
  const Work& work = world_.work(state);
  const std::vector<TaskIndex>& own = stops.instance().agent(stops.agent()).stops;
  position.stop = static_cast<int>(std::ranges::find(own, work.task) - own.begin());
  position.steps_done = work.done;
  return position;
}

void PathGraph::find_excesses() {
  for (std::size_t i = queue_.size(); i-- > 0;) {
    Data& node = nodes_[queue_[i].first];
    Time excess = node.is_final ? node.time + node.price - least_cost_ : kNever;
    for (const Node next : successors(queue_[i].first))
      excess = std::min(excess, nodes_[next].excess);
    GROVE_ASSERT(excess >= 0, "no walk costs less than the least cost");
    node.excess = excess;
    node.has_all_successors &= std::ranges::all_of(successors(queue_[i].first), [&](Node next) {
      return nodes_[next].excess <= latest_ - least_cost_;
    });
  }
}

std::size_t PathGraph::bytes() const {
  constexpr std::size_t kPerEntry = sizeof(Key) + 40;
  return nodes_.capacity() * sizeof(Data) + successors_.capacity() * sizeof(Node) +
         numbers_.size() * kPerEntry;
}

}  // namespace grove::detail
