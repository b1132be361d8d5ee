// SPDX-License-Identifier: MIT
// Optimal paths for a few agents by A* over joint states.
//
// *States.* A joint state holds a node of agent_graph.h for each agent. A step moves all agents at
// once and costs 1 for each agent that is not at rest, so the cost of a path is the sum of the
// finish times. To rest forever is a decision: an agent that could rest may continue instead, at a
// cost.
//
// *Estimate.* The estimate is the sum of the agents' individual costs to go, plus what groups of
// two or three agents cost more together (database_groups.h). The groups of a grouping share no
// agent; the best grouping counts. In any plan each group costs at least that much, so the estimate
// is admissible.
//
// *Layers.* The queue is ordered by the *layer* of a state, which is its cost + estimate. Layers
// are emptied in ascending order. *Claim: the current layer is a lower bound on all plans below the
// cutoff, and the first state taken whose individual costs to go are all 0 ends an optimal plan.*
// *Proof.* For each such plan there is always a state on its way in the queue whose layer is at
// most the plan's cost. (A state that is reached at a lower cost enters the queue again, even if it
// has been expanded.) States whose layer reaches the cutoff are dropped, because plans through them
// cost at least the cutoff. So an empty queue proves that no plan costs less than the cutoff, or
// that there is no plan if there is no cutoff.
//
// *Late databases.* A larger pattern database is made once the search has taken as much effort as
// this and all earlier databases take. If a state that is taken from the queue has an estimate from
// before the newest database, the estimate is recomputed.
//
// *Enhanced partial expansion* (Goldenberg et al., JAIR 2014). The delta_f of a move is its
// increase of the agent's individual cost, which is never negative. An expansion generates the
// successors whose total delta_f is within the budget that the state's layer leaves. The state then
// re-enters the queue with the next budget that occurs. So no successor is generated that costs
// more than the optimum even by the sum of individual costs. Moves are chosen agent by agent. The
// next budget is the least total delta_f above the current budget of a collision-free prefix of
// moves. Each such prefix can be continued with delta_f 0, or else it collides and the state is
// taken again, without new successors, with a greater budget.
#include "joint/epea_star.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "joint/database_groups.h"
#include "joint/joint_moves.h"
#include "joint/joint_states.h"
#include "joint/layer_queue.h"
#include "model/assert.h"
#include "model/effort.h"
#include "model/plan.h"

namespace grove::detail {
namespace {

using Node = AgentGraph::Node;
using Index = JointStates::Index;
constexpr Index kNone = JointStates::kNone;
constexpr std::int64_t kStatesPerPoll = 256;

}  // namespace

class EpeaStar::Search {
 public:
  // `tables`: whether to use pattern databases. `known_bound`: known lower bound on all plans.
  Search(const Instance& instance, std::vector<AgentGraph> agents, std::size_t max_bytes,
         bool tables, Cost known_bound)
      : instance_(instance),
        agents_(std::move(agents)),
        max_bytes_(max_bytes),
        groups_(instance, agents_),
        known_(agents_.size()),
        moves_(instance, agents_) {
    if (std::ranges::any_of(agents_, [](const auto& agent) { return agent.count() == 0; })) return;
    for (const AgentGraph& agent : agents_) individual_costs_ += agent.to_go(AgentGraph::start());
    if (tables) groups_.plan();
    queue_ = LayerQueue(std::max<Cost>(individual_costs_, known_bound));
    if (!groups_.is_early_due()) begin();
  }

  Outcome run(std::int64_t states, Cost cutoff, const Limits& limits) {
    if (groups_.is_early_due())
      return make_database(limits) ? Outcome::kWorking : Outcome::kTooLarge;
    // Late databases take at most half of the effort.
    if (groups_.is_late_due(generated_ / effort::kJointStates))
      return groups_.make_late(limits) ? Outcome::kWorking : Outcome::kTooLarge;
    for (; states > 0 && !paths_; --states) {
      const Index state =
          queue_.pop([&](Index queued, Cost layer) { return known_[queued].layer == layer; });
      if (state == kNone || queue_.layer() >= cutoff) return Outcome::kEnded;
      if (++states_ % kStatesPerPoll == 0 && (limits.stop_requested() || bytes() > max_bytes_))
        return Outcome::kTooLarge;
      if (is_final(state))
        finish(state);
      else if (!rises(state, cutoff))
        expand(state, cutoff);
    }
    return paths_ ? Outcome::kEnded : Outcome::kWorking;
  }

  Cost lower_bound() const { return queue_.layer(); }
  const std::optional<std::vector<Path>>& paths() const { return paths_; }
  std::optional<Plan> plan() const {
    if (!paths_) return std::nullopt;
    Plan plan;
    for (std::size_t i = 0; i < size(); ++i) {
      plan.agents.push_back(plan_of_path(instance_, agents_[i].agent(), (*paths_)[i]));
      plan.cost += plan.agents.back().cost;
    }
    return plan;
  }
  std::int64_t states() const { return states_; }
  std::int64_t work() const { return groups_.work() + generated_ / effort::kJointStates; }

 private:
  bool make_database(const Limits& limits) {
    if (!groups_.make_next(limits)) return false;
    if (!groups_.is_early_due()) begin();
    return true;
  }
  void begin() {
    const std::vector<Node> start(size(), AgentGraph::start());
    reach(start.data(), JointStates::hash_of(start.data(), size()), kNone, 0, individual_costs_);
  }

  std::size_t size() const { return agents_.size(); }
  std::size_t bytes() const { return known_.bytes() + queue_.bytes() + groups_.bytes(); }

  // Records that a state is reached at this cost, if the cost is less than before and the layer is
  // below the cutoff. A state that is known at this cost needs no new estimate.
  void reach(const Node* nodes, std::uint64_t hash, Index parent, std::int32_t cost,
             std::int32_t individual_costs) {
    ++generated_;
    GROVE_ASSERT(parent == kNone || (cost >= known_[parent].cost &&
                                     cost + individual_costs >=
                                         known_[parent].cost + known_[parent].individual_costs),
                 "a move lowers neither the cost nor its sum with the individual costs to go");
    Index& slot = known_.slot(nodes, hash);
    if (slot != kNone && known_[slot].cost <= cost) return;
    const Cost layer = std::max(queue_.layer(), cost + individual_costs + groups_.excess(nodes));
    if (layer >= cutoff_) return;
    if (slot == kNone) known_.add(slot, nodes);
    known_[slot] = {parent,           cost, static_cast<std::int32_t>(layer),
                    individual_costs, -1,   static_cast<std::uint32_t>(groups_.count())};
    queue_.push(slot, layer);
  }
  // If a database made since the last estimate raises the layer of the state, queues the state in
  // the new layer, or drops it if the new layer reaches the cutoff, and returns true.
  bool rises(Index state, Cost cutoff) {
    JointStates::Record& record = known_[state];
    if (record.tables == groups_.count()) return false;
    record.tables = static_cast<std::uint32_t>(groups_.count());
    const Cost layer =
        record.cost + record.individual_costs + groups_.excess(known_.nodes_of(state));
    if (layer <= record.layer) return false;
    if (layer >= cutoff) return true;
    record.layer = static_cast<std::int32_t>(layer);
    queue_.push(state, layer);
    return true;
  }
  bool is_final(Index state) const { return known_[state].individual_costs == 0; }

  void expand(Index state, Cost cutoff) {
    cutoff_ = cutoff;
    const JointStates::Record& before = known_[state];
    const Time budget = before.layer - before.cost - before.individual_costs;
    const Time next_budget =
        moves_.generate(known_.nodes_of(state), before.cost, before.expanded_budget, budget);
    reach_successors(state);
    if (next_budget == kNever) return;
    JointStates::Record& record = known_[state];
    const Cost layer = record.cost + record.individual_costs + next_budget;
    if (layer >= cutoff) return;
    record.expanded_budget = budget;
    record.layer = static_cast<std::int32_t>(layer);
    queue_.push(state, layer);
  }

  // Ends the search with the paths to a final state.
  void finish(Index last) {
    const std::vector<Node> start(size(), AgentGraph::start());
    const Cost cost = known_[last].cost;
    GROVE_CHECK(cost == queue_.layer(), "the plan found costs as much as the lower bound");
    GROVE_CHECK(individual_costs_ + groups_.excess(start.data()) <= cost,
                "the estimate at the start does not exceed the cost of a plan");
    paths_ = paths_to(last);
    Cost sum = 0;
    for (const Path& path : *paths_) sum += std::ssize(path) - 1;
    GROVE_CHECK(sum == cost, "the cost of a final state is the sum of its paths' costs");
  }

  // First prefetches the hash slots of all successors, then their records.
  void reach_successors(Index parent) {
    const auto successors = moves_.successors();
    for (const auto& successor : successors) known_.prefetch_slot(successor.hash);
    for (const auto& successor : successors) known_.prefetch_state(successor.hash);
    // The successors generated first tend to have the least delta_f. They are pushed last, so that
    // a layer returns them first.
    for (std::size_t i = successors.size(); i-- > 0;)
      reach(moves_.nodes_of(i), successors[i].hash, parent, successors[i].cost,
            successors[i].individual_costs);
  }

  std::vector<Path> paths_to(Index last) const {
    std::vector<Index> way;
    for (Index state = last; state != kNone; state = known_[state].parent) way.push_back(state);
    std::ranges::reverse(way);
    std::vector<Path> paths(size());
    for (std::size_t agent = 0; agent < size(); ++agent)
      for (const Index state : way)
        if (const Node node = known_.nodes_of(state)[agent]; !agents_[agent].rests(node))
          paths[agent].push_back(agents_[agent].state(node));
    return paths;
  }

  const Instance& instance_;
  const std::vector<AgentGraph> agents_;
  const std::size_t max_bytes_;
  DatabaseGroups groups_;
  std::int32_t individual_costs_ = 0;  // sum of individual costs to go at the start
  JointStates known_;
  LayerQueue queue_;
  JointMoves moves_;
  Cost cutoff_ = kInfiniteCost;  // of the current call of run()
  std::int64_t states_ = 0;
  std::int64_t generated_ = 0;  // joint states generated, repetitions included
  std::optional<std::vector<Path>> paths_;
};

namespace {

std::size_t max_nodes_within(double bits) {
  return static_cast<std::size_t>(std::exp2(std::clamp(bits, 0.0, 12.0)));
}

}  // namespace

EpeaStar::EpeaStar(std::unique_ptr<Search> search) : search_(std::move(search)) {}
EpeaStar::EpeaStar(const Instance& instance, std::vector<AgentGraph> agents, std::size_t max_bytes,
                   Cost known_bound)
    : search_(
          std::make_unique<Search>(instance, std::move(agents), max_bytes, false, known_bound)) {}
EpeaStar::~EpeaStar() = default;

std::unique_ptr<EpeaStar> EpeaStar::make(const Instance& instance, double max_bits,
                                         std::size_t max_bytes) try {
  const double states_bits = std::log2(instance.world().state_count());
  if (instance.agent_count() > kMaxAgents || instance.agent_count() * states_bits > max_bits)
    return nullptr;
  std::vector<AgentGraph> agents;
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    auto graph = AgentGraph::make(instance, agent, max_nodes_within(max_bits));
    if (!graph) return nullptr;
    max_bits -= std::log2(std::max<std::size_t>(graph->count(), 1));
    agents.push_back(std::move(*graph));
  }
  return std::unique_ptr<EpeaStar>(
      new EpeaStar(std::make_unique<Search>(instance, std::move(agents), max_bytes, true, 0)));
} catch (const std::bad_alloc&) {
  return nullptr;
}

EpeaStar::Outcome EpeaStar::run(std::int64_t states, Cost cutoff, const Limits& limits) try {
  return search_->run(states, cutoff, limits);
} catch (const std::bad_alloc&) {  // lower_bound() remains the current layer
  return Outcome::kTooLarge;
}
Cost EpeaStar::lower_bound() const {
  return search_->lower_bound();
}
const std::optional<std::vector<Path>>& EpeaStar::paths() const {
  return search_->paths();
}
std::optional<Plan> EpeaStar::plan() const {
  return search_->plan();
}
std::int64_t EpeaStar::states() const {
  return search_->states();
}
std::int64_t EpeaStar::work() const {
  return search_->work();
}

}  // namespace grove::detail
