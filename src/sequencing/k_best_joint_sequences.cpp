// SPDX-License-Identifier: MIT
// The K best joint sequences (paper, Algorithm 3). A joint sequence is a vector of ranks, one per
// agent.
//
// *Enumeration.* A greater rank never has a lower cost, so a best-first search from the zero vector
// finds all vectors in order of cost. The paper increases *every* rank of each vector and so
// reaches {1,1,0} twice. Here each vector except zero has exactly one parent: the vector with its
// last nonzero rank reduced by one. So if agent j has the last nonzero rank of a vector, the
// children of the vector increase the rank of j or of an agent after j. A child is omitted if its
// rank is beyond the end of the list of its agent. All its descendants are beyond that end as well,
// so no valid vector is lost.
//
// *Entries.* An entry of the queue is a difference: a vector that was returned earlier (its base),
// and the rank of one agent after the last nonzero rank of the base. Its key is (cost of the base)
// + (bound on the cost of that rank) - (cost of the agent's best sequence), which is at most its
// true cost. A key becomes stale when a list improves its bound. The entry at the top of the queue
// is updated and resolved up to its key. It is returned only if its cost is known and equals the
// key. Therefore the order is correct, and the key at the top is a proven lower bound on the next
// cost.
#include "sequencing/k_best_joint_sequences.h"

#include <algorithm>
#include <utility>

#include "model/assert.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/keyed_stacks.h"

namespace grove::detail {

class KBestJointSequences::Queue {
 public:
  Queue(std::vector<KBestSequences> agents, const Limits& limits)
      : agents_(std::move(agents)), limits_(limits) {}

  Cost lower_bound() const {
    if (returned_.empty()) return cost_of_best();
    return queue_.empty() ? kInfiniteCost : queue_.top_key();
  }

  std::optional<JointSequence> next() {
    if (returned_.empty()) return first();
    while (!queue_.empty() && !limits_.stop_requested()) {
      const Cost key = queue_.top_key();
      const Entry entry = queue_.pop();
      KBestSequences& list = agents_[entry.agent];
      if (cost_bound(entry) == key && !list.known(entry.rank))
        list.resolve(entry.rank, list.cost_bound(entry.rank));
      const Cost bound = cost_bound(entry);
      if (bound == key && list.known(entry.rank)) return return_next(entry, key);
      if (bound < kInfiniteCost) queue_.push(bound, entry);
      if (bound == key) break;  // not known, not proven to cost more: limit or solver stop
    }
    return std::nullopt;
  }

  const Sequence& sequence(AgentIndex agent, std::uint32_t rank) {
    return agents_[agent].sequence(rank);
  }

  std::int64_t rtsp_calls() const {
    std::int64_t calls = 0;
    for (const KBestSequences& list : agents_) calls += list.rtsp_calls();
    return calls;
  }

 private:
  // The vector returned_[base], which is zero from `agent` on, with `rank` in place of the rank of
  // `agent`.
  struct Entry {
    std::uint32_t base = 0;
    std::uint32_t agent = 0;
    std::uint32_t rank = 0;
  };
  struct Returned {
    Cost cost = 0;
    Entry entry;
  };

  // Returns the cost of the zero vector, or a lower bound on it if a list has not resolved rank 0.
  Cost cost_of_best() const {
    Cost sum = 0;
    for (const KBestSequences& list : agents_) {
      const Time cost = list.cost_bound(0);
      if (cost >= kNever) return kInfiniteCost;
      sum += cost;
    }
    return sum;
  }

  std::optional<JointSequence> first() {
    for (KBestSequences& list : agents_) {
      if (list.resolve(0, kNever) >= kNever || !list.known(0)) return std::nullopt;
    }
    const Cost cost = cost_of_best();
    returned_.push_back({cost, {}});
    add_children(0, 0);
    return JointSequence{cost, std::vector<std::uint32_t>(agents_.size(), 0)};
  }

  Cost cost_bound(const Entry& entry) const {
    const KBestSequences& list = agents_[entry.agent];
    const Time bound = list.cost_bound(entry.rank);
    if (bound >= kNever) return kInfiniteCost;
    return returned_[entry.base].cost + bound - list.cost_bound(0);
  }

  void add(const Entry& entry) {
    if (const Cost bound = cost_bound(entry); bound < kInfiniteCost) queue_.push(bound, entry);
  }

  // Adds rank 1 for each agent from `begin` on; none of them has a nonzero rank in returned_[base].
  void add_children(std::uint32_t base, std::uint32_t begin) {
    for (auto agent = begin; agent < agents_.size(); ++agent) add({base, agent, 1});
  }

  JointSequence return_next(const Entry& entry, Cost cost) {
    GROVE_CHECK(cost >= returned_.back().cost,
                "joint sequences are returned in ascending order of cost");
    const auto index = static_cast<std::uint32_t>(returned_.size());
    returned_.push_back({cost, entry});
    add({entry.base, entry.agent, entry.rank + 1});
    GROVE_ASSERT(cost_of(ranks(index)) == cost,
                 "the cost of a joint sequence is the sum of its sequences' costs");
    GROVE_ASSERT(entry.rank > 0 && ranks(entry.base)[entry.agent] == 0,
                 "a joint sequence is the child of one other");
    add_children(index, entry.agent + 1);
    return {cost, ranks(index)};
  }

  Cost cost_of(const std::vector<std::uint32_t>& ranks) const {
    Cost sum = 0;
    for (std::size_t agent = 0; agent < ranks.size(); ++agent)
      sum += agents_[agent].cost_bound(ranks[agent]);
    return sum;
  }

  // Index 0 is the zero vector; every chain of bases ends there.
  std::vector<std::uint32_t> ranks(std::uint32_t index) const {
    std::vector<std::uint32_t> ranks(agents_.size(), 0);
    for (; index != 0; index = returned_[index].entry.base)
      ranks[returned_[index].entry.agent] = returned_[index].entry.rank;
    return ranks;
  }

  std::vector<KBestSequences> agents_;
  const Limits& limits_;
  std::vector<Returned> returned_;
  KeyedStacks<Cost, Entry> queue_;
};

KBestJointSequences::KBestJointSequences(std::vector<KBestSequences> agents, const Limits& limits)
    : queue_(std::make_unique<Queue>(std::move(agents), limits)) {}
KBestJointSequences::~KBestJointSequences() = default;
KBestJointSequences::KBestJointSequences(KBestJointSequences&&) noexcept = default;

Cost KBestJointSequences::lower_bound() const {
  return queue_->lower_bound();
}
std::optional<JointSequence> KBestJointSequences::next() {
  return queue_->next();
}
const Sequence& KBestJointSequences::sequence(AgentIndex agent, std::uint32_t rank) {
  return queue_->sequence(agent, rank);
}
std::int64_t KBestJointSequences::rtsp_calls() const {
  return queue_->rtsp_calls();
}

}  // namespace grove::detail
