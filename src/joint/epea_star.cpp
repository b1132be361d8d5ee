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
#include <limits>
#include <new>
#include <utility>

#include "joint/database_groups.h"
#include "model/effort.h"
#include "model/plan.h"

namespace grove::detail {
namespace {

using Node = AgentGraph::Node;
using Index = std::uint32_t;
constexpr Index kNone = std::numeric_limits<Index>::max();
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
        from_on_(static_cast<std::size_t>(instance.world().place_count()), kNoAgent),
        to_on_(from_on_) {
    if (std::ranges::any_of(agents_, [](const auto& agent) { return agent.count() == 0; })) return;
    for (const AgentGraph& agent : agents_) individual_costs_ += agent.to_go(AgentGraph::start());
    if (tables) groups_.plan();
    first_layer_ = lower_bound_ = std::max<Cost>(individual_costs_, known_bound);
    if (!groups_.is_early_due()) begin();
  }

  Outcome run(std::int64_t states, Cost cutoff, const Limits& limits) {
    if (groups_.is_early_due())
      return make_database(limits) ? Outcome::kWorking : Outcome::kTooLarge;
    // Late databases take at most half of the effort.
    if (groups_.is_late_due(generated_ / effort::kJointStates))
      return groups_.make_late(limits) ? Outcome::kWorking : Outcome::kTooLarge;
    for (; states > 0 && !paths_; --states) {
      const Index state = pop();
      if (state == kNone) {
        lower_bound_ = kInfiniteCost;
        return Outcome::kEnded;
      }
      if (lower_bound_ >= cutoff) return Outcome::kEnded;
      if (++states_ % kStatesPerPoll == 0 && (limits.stop_requested() || bytes() > max_bytes_))
        return Outcome::kTooLarge;
      if (is_final(state))
        paths_ = paths_to(state);
      else if (!rises(state, cutoff))
        expand(state, cutoff);
    }
    return paths_ ? Outcome::kEnded : Outcome::kWorking;
  }

  Cost lower_bound() const { return lower_bound_; }
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
  static constexpr std::int8_t kNoAgent = -1;

  struct Record {
    Index parent = kNone;
    std::int32_t cost = 0;              // from the start
    std::int32_t layer = 0;             // lower bound on plans through successors not generated yet
    std::int32_t individual_costs = 0;  // sum of individual costs to go
    std::int32_t expanded_budget = -1;  // expanded up to this total delta_f; -1: not expanded
    std::uint32_t tables = 0;           // number of databases that its layer takes into account
  };

  bool make_database(const Limits& limits) {
    if (!groups_.make_next(limits)) return false;
    if (!groups_.is_early_due()) begin();
    return true;
  }
  void begin() {
    const std::vector<Node> start(size(), AgentGraph::start());
    reach(start.data(), hash_of(start.data()), kNone, 0, individual_costs_);
  }

  std::size_t size() const { return agents_.size(); }
  const Node* nodes_of(Index state) const { return nodes_.data() + state * size(); }
  std::size_t bytes() const {
    return nodes_.capacity() * sizeof(Node) + records_.capacity() * sizeof(Record) +
           slots_.capacity() * sizeof(Index) + queued_ * sizeof(Index) + groups_.bytes();
  }

  // --- the queue: by layer, last in, first out ---

  void push(Index state) {
    const auto layer = static_cast<std::size_t>(records_[state].layer - first_layer_);
    if (layer >= layers_.size()) layers_.resize(layer + 1);
    layers_[layer].push_back(state);
    ++queued_;
  }
  Index pop() {
    for (; at_ < layers_.size(); ++at_, ++lower_bound_) {
      std::vector<Index>& layer = layers_[at_];
      while (!layer.empty()) {
        const Index state = layer.back();
        layer.pop_back();
        --queued_;
        if (records_[state].layer == lower_bound_)
          return state;  // else it is queued in a different layer
      }
      std::vector<Index>().swap(layer);
    }
    return kNone;
  }

  // --- states ---

  std::uint64_t hash_of(const Node* nodes) const {
    std::uint64_t hash = 0;
    for (std::size_t i = 0; i < size(); ++i) hash = (hash ^ nodes[i]) * 0x9e3779b97f4a7c15;
    return hash ^ hash >> 32;
  }
  std::size_t slot_of(const Node* nodes) const { return slot_of(nodes, hash_of(nodes)); }
  std::size_t slot_of(const Node* nodes, std::uint64_t hash) const {
    std::size_t slot = hash & (slots_.size() - 1);
    while (slots_[slot] != kNone && !std::equal(nodes, nodes + size(), nodes_of(slots_[slot])))
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  void grow() {
    slots_.assign(std::max<std::size_t>(1024, 2 * slots_.size()), kNone);
    for (Index state = 0; state < records_.size(); ++state)
      slots_[slot_of(nodes_of(state))] = state;
  }
  // Records that a state is reached at this cost, if the cost is less than before and the layer is
  // below the cutoff. A state that is known at this cost needs no new estimate.
  void reach(const Node* nodes, std::uint64_t hash, Index parent, std::int32_t cost,
             std::int32_t individual_costs) {
    ++generated_;
    if (2 * (records_.size() + 1) > slots_.size()) grow();
    Index& slot = slots_[slot_of(nodes, hash)];
    if (slot != kNone && records_[slot].cost <= cost) return;
    const Cost layer = std::max(lower_bound_, cost + individual_costs + groups_.excess(nodes));
    if (layer >= cutoff_) return;
    if (slot == kNone) {
      slot = static_cast<Index>(records_.size());
      records_.emplace_back();
      nodes_.insert(nodes_.end(), nodes, nodes + size());
    }
    records_[slot] = {parent,           cost, static_cast<std::int32_t>(layer),
                      individual_costs, -1,   static_cast<std::uint32_t>(groups_.count())};
    push(slot);
  }
  // If a database made since the last estimate raises the layer of the state, queues the state in
  // the new layer, or drops it if the new layer reaches the cutoff, and returns true.
  bool rises(Index state, Cost cutoff) {
    Record& record = records_[state];
    if (record.tables == groups_.count()) return false;
    record.tables = static_cast<std::uint32_t>(groups_.count());
    const Cost layer = record.cost + record.individual_costs + groups_.excess(nodes_of(state));
    if (layer <= record.layer) return false;
    if (layer >= cutoff) return true;
    record.layer = static_cast<std::int32_t>(layer);
    push(state);
    return true;
  }
  bool is_final(Index state) const { return records_[state].individual_costs == 0; }

  // --- expansion ---

  void expand(Index state, Cost cutoff) {
    parent_ = state;
    cutoff_ = cutoff;
    from_.assign(nodes_of(state), nodes_of(state) + size());
    to_.resize(size());
    const Record& record_now = records_[state];
    budget_ = record_now.layer - record_now.cost - record_now.individual_costs;
    expanded_budget_ = record_now.expanded_budget;
    next_budget_ = kNever;
    max_delta_f_after_.assign(size() + 1, 0);
    for (std::size_t i = size(); i-- > 0;)
      max_delta_f_after_[i] = max_delta_f_after_[i + 1] + agents_[i].moves(from_[i]).back().delta_f;
    for (std::size_t i = 0; i < size(); ++i)
      from_on_[place(i, from_)] = static_cast<std::int8_t>(i);
    choose(0, 0, 0, 0);
    reach_next();
    for (std::size_t i = 0; i < size(); ++i) from_on_[place(i, from_)] = kNoAgent;
    if (next_budget_ == kNever) return;
    Record& record = records_[state];
    const Cost layer = record.cost + record.individual_costs + next_budget_;
    if (layer >= cutoff) return;
    record.expanded_budget = budget_;
    record.layer = static_cast<std::int32_t>(layer);
    push(state);
  }

  // Generates the chosen successors. First prefetches the hash slots of all of them, then their
  // records.
  void reach_next() {
    for (const Next& next : next_) __builtin_prefetch(&slots_[next.hash & (slots_.size() - 1)]);
    for (const Next& next : next_) {
      const Index there = slots_[next.hash & (slots_.size() - 1)];
      if (there == kNone) continue;
      __builtin_prefetch(&records_[there]);
      __builtin_prefetch(nodes_of(there));
    }
    // The successors generated first tend to have the least delta_f. They are pushed last, so that
    // a layer returns them first.
    for (std::size_t i = next_.size(); i-- > 0;)
      reach(next_nodes_.data() + i * size(), next_[i].hash, parent_, next_[i].cost,
            next_[i].individual_costs);
    next_.clear();
    next_nodes_.clear();
  }

  std::size_t place(std::size_t agent, const std::vector<Node>& nodes) const {
    return static_cast<std::size_t>(agents_[agent].place(nodes[agent]));
  }

  // Chooses moves for `agent` and all later agents. The moves of the earlier agents are chosen and
  // cost `cost`.
  void choose(std::size_t agent, Time delta_f, std::int32_t cost, std::int32_t individual_costs) {
    if (agent == size()) {
      next_nodes_.insert(next_nodes_.end(), to_.begin(), to_.end());
      next_.push_back({hash_of(to_.data()), records_[parent_].cost + cost, individual_costs});
      return;
    }
    const AgentGraph& graph = agents_[agent];
    const std::size_t here = place(agent, from_);
    for (const AgentGraph::Move& move : graph.moves(from_[agent])) {
      const Time sum = delta_f + move.delta_f;
      if (sum + max_delta_f_after_[agent + 1] <= expanded_budget_) continue;
      const auto there = static_cast<std::size_t>(graph.place(move.to));
      if (collides(agent, here, there)) continue;
      if (sum > budget_) {
        next_budget_ = std::min(next_budget_, sum);
        return;  // moves are sorted by delta_f
      }
      to_[agent] = move.to;
      to_on_[there] = static_cast<std::int8_t>(agent);
      choose(agent + 1, sum, cost + (graph.rests(move.to) ? 0 : 1),
             individual_costs + graph.to_go(move.to));
      to_on_[there] = kNoAgent;
    }
  }

  // True if the move collides with that of an earlier agent or, where following is forbidden, leads
  // to the current place of any other agent.
  bool collides(std::size_t agent, std::size_t here, std::size_t there) const {
    if (to_on_[there] != kNoAgent) return true;
    if (here == there) return false;
    const std::int8_t who = from_on_[there];
    if (who == kNoAgent) return false;
    if (!instance_.may_follow()) return true;
    return who < static_cast<std::int8_t>(agent) &&
           place(static_cast<std::size_t>(who), to_) == here;
  }

  // --- the paths ---

  std::vector<Path> paths_to(Index last) const {
    std::vector<Index> way;
    for (Index state = last; state != kNone; state = records_[state].parent) way.push_back(state);
    std::ranges::reverse(way);
    std::vector<Path> paths(size());
    for (std::size_t agent = 0; agent < size(); ++agent)
      for (const Index state : way)
        if (const Node node = nodes_of(state)[agent]; !agents_[agent].rests(node))
          paths[agent].push_back(agents_[agent].state(node));
    return paths;
  }

  const Instance& instance_;
  const std::vector<AgentGraph> agents_;
  const std::size_t max_bytes_;
  DatabaseGroups groups_;
  std::int32_t individual_costs_ = 0;  // sum of individual costs to go at the start
  std::vector<Node> nodes_;            // by state, then agent
  std::vector<Record> records_;
  std::vector<Index> slots_;  // hash table; size: a power of two
  std::vector<std::vector<Index>> layers_;
  std::size_t at_ = 0;  // in layers_
  std::size_t queued_ = 0;
  Cost first_layer_ = 0;
  Cost lower_bound_ = 0;  // the layer at position at_
  std::int64_t states_ = 0;
  std::int64_t generated_ = 0;  // joint states generated, repetitions included
  std::optional<std::vector<Path>> paths_;
  // State of the current expansion.
  struct Next {
    std::uint64_t hash;
    std::int32_t cost;  // from the start
    std::int32_t individual_costs;
  };
  std::vector<Next> next_;
  std::vector<Node> next_nodes_;  // the nodes of each successor, by agent
  Index parent_ = kNone;
  Cost cutoff_ = kInfiniteCost;
  Time expanded_budget_ = -1;
  Time budget_ = 0;
  Time next_budget_ = kNever;
  std::vector<Node> from_;
  std::vector<Node> to_;
  std::vector<Time>
      max_delta_f_after_;  // by agent: sum of the largest delta_f of this and all later agents
  std::vector<std::int8_t> from_on_;  // by place: the agent there now
  std::vector<std::int8_t> to_on_;    // by place: the agent that has chosen to move there
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
