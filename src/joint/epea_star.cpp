// SPDX-License-Identifier: MIT
// A joint state says of every agent what it is in (agent_graph.h); a step moves all at once and
// costs as many as are not at rest. So a way costs the sum of the finish times. To rest for ever is
// a decision: who could may as well go on, and pays for it.
//
// The estimate is the sum of what the agents cost alone, and of what groups of two or three cost
// more together (group_table.h), groups that share no agent: of all ways to group agents the best.
// In any plan each group pays at least that, so none is cheaper. States stand in the queue by cost
// and estimate, their *layer*; the layers are emptied from the least on. On the way to any plan
// there is always a state in the queue whose layer is no more than the plan's cost; so the layer
// that is being emptied bounds all plans, and the first state taken with nothing left to pay for
// ends an optimal one. (A state that is reached at less cost goes into the queue again, whatever
// became of it before.) Larger tables are made when the search has taken as much work as they do: a
// state that is taken from the queue with an estimate of before gets a new one. States whose layer
// reaches the cutoff are dropped, for plans through them cost as much; an empty queue proves that
// no plan costs less than the cutoff - without one, none.
//
// Enhanced partial expansion (Goldenberg et al., JAIR 2014). A move's detour is what it adds to
// what its agent costs alone, never less than 0. A state brings forth those next ones whose detours
// are within the budget that its layer leaves, and goes back into the queue with the next budget
// that there is: what costs more than the optimum even by the sum over agents is never made.
// Choosing moves agent by agent, the next budget is the least sum above the budget of a beginning
// without collisions: each can be gone on with without a detour, or else collides and comes again,
// for nothing, with a greater one.
#include "joint/epea_star.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <new>
#include <utility>

#include "joint/pattern_database.h"
#include "model/plan_of_path.h"

namespace grove::detail {
namespace {

using Node = AgentGraph::Node;
using Index = std::uint32_t;
constexpr Index kNone = std::numeric_limits<Index>::max();
constexpr std::size_t kMostGrouped = 8;  // beyond, the best grouping takes too long to find
constexpr std::size_t kMostEntries = std::size_t{1} << 18;  // of a table made at first
constexpr std::int64_t kMostTableWork = 4'000'000;          // of all those; see search/work.h
constexpr std::size_t kMostLateEntries = std::size_t{1} << 21;
constexpr std::size_t kMostGroupedLate = 6;
constexpr std::int64_t kStatesPerPoll = 256;
constexpr std::int64_t kMadePerWork = 2;  // joint states; see search/work.h

}  // namespace

class EpeaStar::Search {
 public:
  // `tables`: some guide it. No plan costs less than `least`.
  Search(const Instance& instance, std::vector<AgentGraph> agents, std::size_t most_bytes,
         bool tables, Cost least)
      : instance_(instance),
        agents_(std::move(agents)),
        most_bytes_(most_bytes),
        from_on_(static_cast<std::size_t>(instance.world().place_count()), kNobody),
        to_on_(from_on_) {
    if (std::ranges::any_of(agents_, [](const auto& agent) { return agent.count() == 0; })) return;
    for (const AgentGraph& agent : agents_) alone_ += agent.to_go(AgentGraph::start());
    if (tables) plan_tables();
    first_layer_ = lower_bound_ = std::max<Cost>(alone_, least);
    if (tables_to_come_.empty()) begin();
  }

  Outcome run(std::int64_t states, Cost cutoff, const Limits& limits) {
    if (!tables_to_come_.empty())
      return make_table(limits) ? Outcome::kWorking : Outcome::kTooLarge;
    if (late_table_is_due())
      return make_late_table(limits) ? Outcome::kWorking : Outcome::kTooLarge;
    for (; states > 0 && !paths_; --states) {
      const Index state = pop();
      if (state == kNone) {
        lower_bound_ = kInfiniteCost;
        return Outcome::kEnded;
      }
      if (lower_bound_ >= cutoff) return Outcome::kEnded;
      if (++states_ % kStatesPerPoll == 0 && (limits.stop_requested() || bytes() > most_bytes_))
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
  std::int64_t work() const { return table_work_ + made_ / kMadePerWork; }

 private:
  static constexpr std::int8_t kNobody = -1;

  struct Record {
    Index parent = kNone;
    std::int32_t cost = 0;        // from the start
    std::int32_t layer = 0;       // no plan by a way not yet looked at costs less
    std::int32_t alone = 0;       // the sum of what its agents cost alone from there
    std::int32_t looked_at = -1;  // detours up to this; -1: none
    std::uint32_t tables = 0;     // that its layer knows of
  };

  // Groups that share no agent, by number; the rest is none.
  using Grouping = std::array<std::uint8_t, kMostGrouped / 2>;

  // All pairs, then threes, those that are small enough. (Of two agents the search is the table.)
  void plan_tables() {
    if (size() < 3 || size() > kMostGrouped) return;
    for (std::size_t a = 0; a < size(); ++a)
      for (std::size_t b = a + 1; b < size(); ++b) plan_table({a, b});
    for (std::size_t a = 0; a < size() && size() > 3; ++a)
      for (std::size_t b = a + 1; b < size(); ++b)
        for (std::size_t c = b + 1; c < size(); ++c) plan_table({a, b, c});
    std::ranges::stable_sort(late_tables_, {},
                             [&](const auto& members) { return work_of(members); });
  }
  void plan_table(std::vector<std::size_t> members) {
    const std::size_t entries = PatternDatabase::entries(agents_, members);
    if (entries <= kMostEntries && planned_work_ + work_of(members) <= kMostTableWork) {
      planned_work_ += work_of(members);
      tables_to_come_.push_back(std::move(members));
    } else if (entries <= kMostLateEntries && size() <= kMostGroupedLate) {
      late_tables_.push_back(std::move(members));
    }
  }
  std::int64_t work_of(const std::vector<std::size_t>& members) const {
    return PatternDatabase::work(agents_, members);
  }
  // False: stopped.
  bool add_table(std::deque<std::vector<std::size_t>>& from, const Limits& limits) {
    auto table = PatternDatabase::make(instance_, agents_, from.front(), limits);
    if (!table) return false;
    tables_.push_back(std::move(*table));
    table_work_ += work_of(from.front());
    table_bytes_ += PatternDatabase::entries(agents_, from.front());
    from.pop_front();
    return true;
  }
  bool make_table(const Limits& limits) {
    if (!add_table(tables_to_come_, limits)) return false;
    if (tables_to_come_.empty()) begin();
    return true;
  }
  // Tables take no more than half of the work.
  bool late_table_is_due() const {
    return !late_tables_.empty() &&
           table_work_ + work_of(late_tables_.front()) <= made_ / kMadePerWork;
  }
  bool make_late_table(const Limits& limits) {
    if (!add_table(late_tables_, limits)) return false;
    group();
    return true;
  }
  void begin() {
    group();
    const std::vector<Node> start(size(), AgentGraph::start());
    reach(start.data(), hash_of(start.data()), kNone, 0, alone_);
  }
  void group() {
    excess_.assign(tables_.size() + 1, 0);
    groupings_.clear();
    Grouping none;
    none.fill(static_cast<std::uint8_t>(tables_.size()));
    add_groupings(0, 0, none, 0);
  }
  // All ways to go on with groups from `first` on, of agents that are free, until there is none.
  void add_groupings(std::size_t first, unsigned taken, Grouping so_far, std::size_t count) {
    bool ends = true;
    for (std::size_t i = 0; i < tables_.size() && count < so_far.size(); ++i) {
      unsigned members = 0;
      for (const std::size_t member : tables_[i].members()) members |= 1u << member;
      if ((taken & members) != 0) continue;
      ends = false;
      if (i < first) continue;
      so_far[count] = static_cast<std::uint8_t>(i);
      add_groupings(i + 1, taken | members, so_far, count + 1);
    }
    if (ends && count > 0) groupings_.push_back(so_far);
  }

  std::size_t size() const { return agents_.size(); }
  const Node* nodes_of(Index state) const { return nodes_.data() + state * size(); }
  std::size_t bytes() const {
    return nodes_.capacity() * sizeof(Node) + records_.capacity() * sizeof(Record) +
           slots_.capacity() * sizeof(Index) + queued_ * sizeof(Index) + table_bytes_;
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
        if (records_[state].layer == lower_bound_) return state;  // else it is queued elsewhere
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
  // Is it of use to reach a state at this cost? What is known already needs no estimate.
  void reach(const Node* nodes, std::uint64_t hash, Index parent, std::int32_t cost,
             std::int32_t alone) {
    ++made_;
    if (2 * (records_.size() + 1) > slots_.size()) grow();
    Index& slot = slots_[slot_of(nodes, hash)];
    if (slot != kNone && records_[slot].cost <= cost) return;
    const Cost layer = std::max(lower_bound_, cost + alone + excess_of(nodes));
    if (layer >= cutoff_) return;
    if (slot == kNone) {
      slot = static_cast<Index>(records_.size());
      records_.emplace_back();
      nodes_.insert(nodes_.end(), nodes, nodes + size());
    }
    records_[slot] = {parent, cost, static_cast<std::int32_t>(layer),
                      alone,  -1,   static_cast<std::uint32_t>(tables_.size())};
    push(slot);
  }
  // Does a table made since put a state into a later layer? It is queued there then.
  bool rises(Index state, Cost cutoff) {
    Record& record = records_[state];
    if (record.tables == tables_.size()) return false;
    record.tables = static_cast<std::uint32_t>(tables_.size());
    const Cost layer = record.cost + record.alone + excess_of(nodes_of(state));
    if (layer <= record.layer) return false;
    if (layer >= cutoff) return true;
    record.layer = static_cast<std::int32_t>(layer);
    push(state);
    return true;
  }
  bool is_final(Index state) const { return records_[state].alone == 0; }

  // What groups cost more together, at least: over all agents, the best way to group them.
  Cost excess_of(const Node* nodes) {
    for (std::size_t i = 0; i < tables_.size(); ++i) {
      const std::uint8_t excess = tables_[i].excess(nodes);
      if (excess == PatternDatabase::kUnreachable) return kInfiniteCost;
      excess_[i] = excess;
    }
    int best = 0;
    for (const Grouping& grouping : groupings_) {
      int sum = 0;
      for (const std::uint8_t table : grouping) sum += excess_[table];
      best = std::max(best, sum);
    }
    return best;
  }

  // --- one step of all ---

  void expand(Index state, Cost cutoff) {
    parent_ = state;
    cutoff_ = cutoff;
    from_.assign(nodes_of(state), nodes_of(state) + size());
    to_.resize(size());
    const Record& record_now = records_[state];
    budget_ = record_now.layer - record_now.cost - record_now.alone;
    looked_at_ = record_now.looked_at;
    next_budget_ = kNever;
    most_.assign(size() + 1, 0);
    for (std::size_t i = size(); i-- > 0;)
      most_[i] = most_[i + 1] + agents_[i].moves(from_[i]).back().delta_f;
    for (std::size_t i = 0; i < size(); ++i)
      from_on_[place(i, from_)] = static_cast<std::int8_t>(i);
    choose(0, 0, 0, 0);
    reach_next();
    for (std::size_t i = 0; i < size(); ++i) from_on_[place(i, from_)] = kNobody;
    if (next_budget_ == kNever) return;
    Record& record = records_[state];
    const Cost layer = record.cost + record.alone + next_budget_;
    if (layer >= cutoff) return;
    record.looked_at = budget_;
    record.layer = static_cast<std::int32_t>(layer);
    push(state);
  }

  // What has been chosen. Where they may be known is looked up in memory for all at once.
  void reach_next() {
    for (const Next& next : next_) __builtin_prefetch(&slots_[next.hash & (slots_.size() - 1)]);
    for (const Next& next : next_) {
      const Index there = slots_[next.hash & (slots_.size() - 1)];
      if (there == kNone) continue;
      __builtin_prefetch(&records_[there]);
      __builtin_prefetch(nodes_of(there));
    }
    // Those with the least detours come last, to be taken first where a layer has room for more.
    for (std::size_t i = next_.size(); i-- > 0;)
      reach(next_nodes_.data() + i * size(), next_[i].hash, parent_, next_[i].cost, next_[i].alone);
    next_.clear();
    next_nodes_.clear();
  }

  std::size_t place(std::size_t agent, const std::vector<Node>& nodes) const {
    return static_cast<std::size_t>(agents_[agent].place(nodes[agent]));
  }

  // The moves of `agent` and all after it; those before have chosen and pay `cost`.
  void choose(std::size_t agent, Time delta_f, std::int32_t cost, std::int32_t alone) {
    if (agent == size()) {
      next_nodes_.insert(next_nodes_.end(), to_.begin(), to_.end());
      next_.push_back({hash_of(to_.data()), records_[parent_].cost + cost, alone});
      return;
    }
    const AgentGraph& graph = agents_[agent];
    const std::size_t here = place(agent, from_);
    for (const AgentGraph::Move& move : graph.moves(from_[agent])) {
      const Time sum = delta_f + move.delta_f;
      if (sum + most_[agent + 1] <= looked_at_) continue;
      const auto there = static_cast<std::size_t>(graph.place(move.to));
      if (collides(agent, here, there)) continue;
      if (sum > budget_) {
        next_budget_ = std::min(next_budget_, sum);
        return;  // the others are no less
      }
      to_[agent] = move.to;
      to_on_[there] = static_cast<std::int8_t>(agent);
      choose(agent + 1, sum, cost + (graph.rests(move.to) ? 0 : 1), alone + graph.to_go(move.to));
      to_on_[there] = kNobody;
    }
  }

  // With those who have chosen; without following with all.
  bool collides(std::size_t agent, std::size_t here, std::size_t there) const {
    if (to_on_[there] != kNobody) return true;
    if (here == there) return false;
    const std::int8_t who = from_on_[there];
    if (who == kNobody) return false;
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
  const std::size_t most_bytes_;
  std::deque<std::vector<std::size_t>> tables_to_come_;  // their members
  std::deque<std::vector<std::size_t>> late_tables_;     // the same of larger ones
  std::int64_t planned_work_ = 0;
  std::int32_t alone_ = 0;  // the sum of what the agents cost alone
  std::vector<PatternDatabase> tables_;
  std::vector<Grouping> groupings_;  // all that no group could be added to
  std::vector<int> excess_;          // of the state being made, by table; one more, of none: 0
  std::vector<Node> nodes_;          // by state, then agent
  std::vector<Record> records_;
  std::vector<Index> slots_;  // a power of two
  std::vector<std::vector<Index>> layers_;
  std::size_t at_ = 0;  // in layers_
  std::size_t queued_ = 0;
  Cost first_layer_ = 0;
  Cost lower_bound_ = 0;  // of the layer at_
  std::int64_t states_ = 0;
  std::int64_t made_ = 0;  // joint states, again and again
  std::int64_t table_work_ = 0;
  std::size_t table_bytes_ = 0;
  std::optional<std::vector<Path>> paths_;
  // The expansion under way.
  struct Next {
    std::uint64_t hash;
    std::int32_t cost;  // from the start
    std::int32_t alone;
  };
  std::vector<Next> next_;
  std::vector<Node> next_nodes_;  // of each, by agent
  Index parent_ = kNone;
  Cost cutoff_ = kInfiniteCost;
  Time looked_at_ = -1;
  Time budget_ = 0;
  Time next_budget_ = kNever;
  std::vector<Node> from_;
  std::vector<Node> to_;
  std::vector<Time> most_;            // detours of an agent and all after it
  std::vector<std::int8_t> from_on_;  // by place: the agent that is there
  std::vector<std::int8_t> to_on_;    // and that has chosen to be
};

namespace {

std::size_t most_nodes_within(double bits) {
  return static_cast<std::size_t>(std::exp2(std::clamp(bits, 0.0, 12.0)));
}

}  // namespace

EpeaStar::EpeaStar(std::unique_ptr<Search> search) : search_(std::move(search)) {}
EpeaStar::EpeaStar(const Instance& instance, std::vector<AgentGraph> agents, std::size_t most_bytes,
                   Cost least)
    : search_(std::make_unique<Search>(instance, std::move(agents), most_bytes, false, least)) {}
EpeaStar::~EpeaStar() = default;

std::unique_ptr<EpeaStar> EpeaStar::make(const Instance& instance, double most_bits,
                                         std::size_t most_bytes) try {
  const double states_bits = std::log2(instance.world().state_count());
  if (instance.agent_count() > kMostAgents || instance.agent_count() * states_bits > most_bits)
    return nullptr;
  std::vector<AgentGraph> agents;
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    auto graph = AgentGraph::make(instance, agent, most_nodes_within(most_bits));
    if (!graph) return nullptr;
    most_bits -= std::log2(std::max<std::size_t>(graph->count(), 1));
    agents.push_back(std::move(*graph));
  }
  return std::unique_ptr<EpeaStar>(
      new EpeaStar(std::make_unique<Search>(instance, std::move(agents), most_bytes, true, 0)));
} catch (const std::bad_alloc&) {
  return nullptr;
}

EpeaStar::Outcome EpeaStar::run(std::int64_t states, Cost cutoff, const Limits& limits) try {
  return search_->run(states, cutoff, limits);
} catch (const std::bad_alloc&) {  // its bound is that of the layer being emptied
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
