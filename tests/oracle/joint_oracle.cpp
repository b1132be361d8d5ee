// SPDX-License-Identifier: MIT
// A* over joint states. A joint state holds, for every agent, its pose, its task in execution, the
// tasks that it has visited and whether it rests forever (agent_states.h). A step moves all agents
// at the same time and costs the number of agents that are not at rest. The cost of a path is
// therefore the sum of the agents' finish times: an agent pays for every step, waits included,
// until it rests forever. Resting is a decision. An agent that may rest can also continue to pay
// and leave again.
//
// *Soundness.* The heuristic is the sum of the agents' exact individual costs-to-go. A step either
// costs an agent 1 and lowers its cost-to-go by at most 1, or costs 0 and leaves its cost-to-go at
// 0. The heuristic is therefore consistent, a state's cost is final when the state is taken from
// the queue, and the first state taken in which all agents may rest and all needs are met is
// optimal. (An agent visits each task that it may visit, and that takes no time, as soon as it is
// on the place of the task, because this costs nothing.) There are finitely many states, so an
// empty queue proves that there is no plan. A state is dropped if some agent, even ignoring the
// others, can no longer finish, because no plan passes through that state.
//
// The oracle shares only the model layer with Grove.
#include "tests/oracle/joint_oracle.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "tests/oracle/agent_states.h"

namespace grove::detail::oracle {
namespace {

using Key = std::uint64_t;
using State = AgentStates::State;
using NodeIndex = std::uint32_t;
constexpr NodeIndex kNoNode = UINT32_MAX;

struct Node {
  Key key = 0;
  NodeIndex parent = kNoNode;
  Time cost = 0;
  bool closed = false;
};

// Hash table of nodes by key: open addressing, at most half full.
class NodeTable {
 public:
  // Returns the node of `key`, after appending it to `nodes` if it is new.
  NodeIndex find_or_add(Key key, std::vector<Node>& nodes) {
    if ((nodes.size() + 1) * 2 > slots_.size()) grow(nodes);
    NodeIndex& slot = slots_[find(key, nodes)];
    if (slot == kNoNode) {
      slot = static_cast<NodeIndex>(nodes.size());
      nodes.push_back({.key = key, .cost = kNever});
    }
    return slot;
  }

 private:
  std::size_t find(Key key, const std::vector<Node>& nodes) const {
    std::size_t at = (key * 0x9E3779B97F4A7C15u) >> shift_;
    while (slots_[at] != kNoNode && nodes[slots_[at]].key != key)
      at = (at + 1) & (slots_.size() - 1);
    return at;
  }

  void grow(const std::vector<Node>& nodes) {
    slots_.assign(std::max<std::size_t>(1024, slots_.size() * 2), kNoNode);
    shift_ = 64 - std::countr_zero(slots_.size());
    for (NodeIndex n = 0; n < nodes.size(); ++n) slots_[find(nodes[n].key, nodes)] = n;
  }

  std::vector<NodeIndex> slots_;
  int shift_ = 64;
};

class JointAStar {
 public:
  JointAStar(const Instance& instance, std::size_t state_cap)
      : instance_(instance), state_cap_(state_cap) {}

  Answer run();

 private:
  bool prepare();
  State state(Key key, std::size_t agent) const {
    return static_cast<State>((key >> shift_[agent]) & mask_[agent]);
  }
  Time to_go(Key key) const;
  bool needs_met(Key key) const;
  NodeIndex pop();
  void expand(NodeIndex node);
  void advance(std::size_t agent, Key key, Time cost);
  bool collides(std::size_t agent, State to) const;
  void reach(Key key, Time cost);
  Plan plan(NodeIndex last) const;
  AgentPlan agent_plan(std::size_t agent, const std::vector<Key>& keys) const;
  void finish_on_last(AgentIndex index, AgentPlan& agent) const;

  const Instance& instance_;
  std::size_t state_cap_;
  std::vector<AgentStates> agents_;
  std::vector<int> shift_;
  std::vector<Key> mask_;
  std::vector<Node> nodes_;
  NodeTable table_;
  std::vector<std::vector<NodeIndex>> buckets_;  // by cost + cost-to-go
  std::size_t first_bucket_ = 0;
  // State of the current expansion:
  NodeIndex parent_ = kNoNode;
  std::vector<State> from_;
  std::vector<State> to_;
};

// Returns false if the joint states of the instance do not fit into a key.
bool JointAStar::prepare() {
  int bits = 0;
  for (AgentIndex a = 0; a < instance_.agent_count(); ++a) {
    try {
      agents_.emplace_back(instance_, a);
    } catch (const AgentStates::TooMany&) {
      return false;
    }
    const auto width =
        static_cast<int>(std::bit_width(static_cast<Key>(agents_.back().count() - 1)));
    shift_.push_back(bits);
    mask_.push_back((Key{1} << width) - 1);
    bits += width;
    if (bits > 64) return false;
  }
  from_.resize(agents_.size());
  to_.resize(agents_.size());
  return true;
}

Time JointAStar::to_go(Key key) const {
  Time sum = 0;
  for (std::size_t a = 0; a < agents_.size(); ++a) {
    const Time alone = agents_[a].to_go(state(key, a));
    if (alone == kNever) return kNever;
    sum += alone;
  }
  return sum;
}

// Is each task visited by as many agents as it needs?
bool JointAStar::needs_met(Key key) const {
  std::vector<int> visitors(instance_.tasks().size());
  for (std::size_t a = 0; a < agents_.size(); ++a) {
    const std::uint64_t visited = agents_[a].standing(state(key, a)).visited;
    for (std::size_t k = 0; k < agents_[a].tasks().size(); ++k)
      if ((visited >> k & 1) != 0) ++visitors[agents_[a].tasks()[k]];
  }
  for (TaskIndex task = 0; task < instance_.task_count(); ++task)
    if (visitors[task] < instance_.task(task).need) return false;
  return true;
}

void JointAStar::reach(Key key, Time cost) {
  const Time left = to_go(key);
  if (left == kNever) return;
  const NodeIndex n = table_.find_or_add(key, nodes_);
  if (nodes_[n].cost <= cost) return;
  nodes_[n].cost = cost;
  nodes_[n].parent = parent_;
  const auto bucket = static_cast<std::size_t>(cost + left);
  if (bucket >= buckets_.size()) buckets_.resize(bucket + 1);
  buckets_[bucket].push_back(n);
}

NodeIndex JointAStar::pop() {
  while (first_bucket_ < buckets_.size()) {
    auto& bucket = buckets_[first_bucket_];
    if (bucket.empty()) {
      ++first_bucket_;
      continue;
    }
    const NodeIndex n = bucket.back();
    bucket.pop_back();
    if (!std::exchange(nodes_[n].closed, true)) return n;
  }
  return kNoNode;
}

bool JointAStar::collides(std::size_t agent, State to) const {
  const auto cell = [&](std::size_t a, State s) { return agents_[a].cell(s); };
  for (std::size_t other = 0; other < agent; ++other) {
    if (cell(other, to_[other]) == cell(agent, to)) return true;
    const bool other_follows = cell(other, to_[other]) == cell(agent, from_[agent]);
    const bool follows = cell(other, from_[other]) == cell(agent, to);
    if ((other_follows && follows) || (!instance_.may_follow() && (other_follows || follows)))
      return true;
  }
  return false;
}

// Enumerates the moves of `agent` and of all later agents, after the moves of the earlier ones are
// chosen.
void JointAStar::advance(std::size_t agent, Key key, Time cost) {
  if (agent == agents_.size()) {
    reach(key, cost);
    return;
  }
  for (const AgentStates::Move& move : agents_[agent].moves(from_[agent])) {
    if (collides(agent, move.to)) continue;
    to_[agent] = move.to;
    advance(agent + 1, key | static_cast<Key>(move.to) << shift_[agent], cost + move.cost);
  }
}

void JointAStar::expand(NodeIndex node) {
  parent_ = node;
  for (std::size_t a = 0; a < agents_.size(); ++a) from_[a] = state(nodes_[node].key, a);
  advance(0, 0, nodes_[node].cost);
}

Answer JointAStar::run() {
  if (!prepare()) return {};
  Key start = 0;
  for (std::size_t a = 0; a < agents_.size(); ++a)
    start |= static_cast<Key>(agents_[a].start()) << shift_[a];
  reach(start, 0);
  for (NodeIndex n = pop(); n != kNoNode; n = pop()) {
    if (to_go(nodes_[n].key) == 0 && needs_met(nodes_[n].key))
      return {Verdict::kSolved, plan(n), nodes_.size()};
    expand(n);
    if (nodes_.size() > state_cap_) return {Verdict::kTooLarge, std::nullopt, nodes_.size()};
  }
  return {Verdict::kInfeasible, std::nullopt, nodes_.size()};
}

Plan JointAStar::plan(NodeIndex last) const {
  std::vector<Key> keys;
  for (NodeIndex n = last; n != kNoNode; n = nodes_[n].parent) keys.push_back(nodes_[n].key);
  std::ranges::reverse(keys);
  Plan plan{nodes_[last].cost, {}};
  for (std::size_t a = 0; a < agents_.size(); ++a) plan.agents.push_back(agent_plan(a, keys));
  return plan;
}

AgentPlan JointAStar::agent_plan(std::size_t agent, const std::vector<Key>& keys) const {
  const AgentStates& states = agents_[agent];
  const auto index = static_cast<AgentIndex>(agent);
  const auto& tasks = states.tasks();
  AgentPlan result;
  std::uint64_t before = 0;
  for (const Key key : keys) {
    const AgentState& here = states.standing(state(key, agent));
    if (here.resting) break;  // at rest since the previous step
    const auto now = static_cast<Time>(result.path.size());
    result.path.push_back(instance_.state_of(index, here.pose));
    for (std::uint64_t bits = here.visited & ~before; bits != 0; bits &= bits - 1) {
      const TaskIndex task = tasks[std::countr_zero(bits)];
      result.sequence.push_back(task);
      if (const Task& t = instance_.task(task); t.has_stated_visits())
        result.work.push_back({task, now - t.duration, now});
    }
    before = here.visited;
  }
  result.cost = static_cast<Time>(result.path.size()) - 1;
  finish_on_last(index, result);
  return result;
}

// Moves the task on which the agent rests to the end of its sequence, because the agent visits it
// last (when it returns to rest there).
void JointAStar::finish_on_last(AgentIndex index, AgentPlan& agent) const {
  if (!instance_.rests_on_last_stop(index) || !agent.work.empty()) return;
  const auto last = std::ranges::find(agent.sequence, instance_.world().place(agent.path.back()),
                                      [&](TaskIndex t) { return instance_.task(t).cell; });
  if (last != agent.sequence.end()) std::rotate(last, last + 1, agent.sequence.end());
}

}  // namespace

Answer solve_jointly(const Instance& instance, std::size_t state_cap) {
  return JointAStar(instance, state_cap).run();
}

}  // namespace grove::detail::oracle
