// SPDX-License-Identifier: MIT
// Depth-first search over pairs of nodes of the same layer. A node determines the place of its
// agent, and the next steps of an agent depend only on its own node. Therefore two walks to the
// same pair have the same continuations, and each pair is expanded once. After the last layer of
// its MDD an agent stays on its last node.
//
// *Definition.* A layer t is a *contact* if the agents could collide there: both MDDs have a node
// on the same place at t, or the agents could swap places from t - 1 to t. (The test uses the
// places of whole layers, so it also reports contacts that no pair of nodes has. Such a contact
// only makes the search longer.)
//
// *Start.* Before the first contact f the agents cannot collide, so each node of layer f - 1 of one
// MDD can be combined with each node of that layer of the other. The search starts from exactly
// these pairs.
//
// *End.* After the last contact the agents cannot collide. If the search reaches a pair in the
// layer of the last contact, the agents are independent, because every node leads to the end of its
// MDD. If it reaches no such pair, all pairs are dead ends, and the agents are dependent.
#include "planning/joint_mdd_search.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kPairsPerPoll = 1024;

using NodeId = Mdd::NodeId;
using Range = Mdd::Range;

// The nodes at `time`, which may be after the last layer.
Range nodes_at(const Mdd& paths, Time time) {
  return paths.layer(std::min(time, paths.cost()));
}

// A set of pairs of nodes. clear() is amortized O(1).
class PairSet {
 public:
  void clear() {
    if (++generation_ == 0) {
      std::ranges::fill(entries_, Entry{});
      generation_ = 1;
    }
    size_ = 0;
  }
  std::size_t size() const { return size_; }

  // Returns false if the pair is in the set already.
  bool insert(NodeId a, NodeId b) {
    if (2 * size_ >= entries_.size()) grow();
    const std::uint64_t key = static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
    Entry& entry = entries_[place_of(key)];
    if (entry.generation == generation_) return false;
    entry = {key, generation_};
    ++size_;
    return true;
  }

 private:
  struct Entry {
    std::uint64_t key = 0;
    std::uint32_t generation = 0;
  };

  std::size_t place_of(std::uint64_t key) const {
    std::uint64_t hash = key * 0x9e3779b97f4a7c15;  // Fibonacci hashing (Knuth)
    std::size_t place = (hash ^ hash >> 32) & (entries_.size() - 1);
    while (entries_[place].generation == generation_ && entries_[place].key != key)
      place = (place + 1) & (entries_.size() - 1);
    return place;
  }
  void grow() {
    std::vector<Entry> old(std::max<std::size_t>(1024, 2 * entries_.size()));
    old.swap(entries_);
    for (const Entry& entry : old)
      if (entry.generation == generation_) entries_[place_of(entry.key)] = entry;
  }

  std::vector<Entry> entries_;  // hash table; its size is a power of two
  std::uint32_t generation_ = 1;
  std::size_t size_ = 0;
};

}  // namespace

class JointMddSearch::Workspace {
 public:
  explicit Workspace(const World& world) {
    for (auto& seen : seen_) seen.assign(world.place_count(), 0);
  }

  Dependence find(const Mdd& a, const Mdd& b, std::size_t max_pairs, const Limits& limits);
  std::int64_t pairs() const { return expanded_; }

 private:
  struct Pair {
    NodeId a;
    NodeId b;
    Time time;
  };

  void find_contacts();
  bool is_contact(Time time) const;
  bool seen_at(Place place, Time time) const { return seen_[time % 2][place] == stamp_ + time; }
  Dependence search(Pair first, const Limits& limits);
  void expand(const Pair& pair);

  const Mdd* a_ = nullptr;
  const Mdd* b_ = nullptr;
  std::size_t max_pairs_ = 0;
  Time first_contact_ = kNever;
  Time last_contact_ = -1;
  PairSet known_;
  std::vector<Pair> open_;
  std::int64_t expanded_ = 0;
  // By parity of the time, then place: stamp_ + the last time at which a_ has a node there.
  std::array<std::vector<std::int64_t>, 2> seen_;
  std::int64_t stamp_ = 1;
};

JointMddSearch::JointMddSearch(const World& world)
    : workspace_(std::make_unique<Workspace>(world)) {}
JointMddSearch::~JointMddSearch() = default;

std::int64_t JointMddSearch::pairs() const {
  return workspace_->pairs();
}

Dependence JointMddSearch::find(const Mdd& a, const Mdd& b, std::size_t max_pairs,
                                const Limits& limits) {
  return workspace_->find(a, b, max_pairs, limits);
}

Dependence JointMddSearch::Workspace::find(const Mdd& a, const Mdd& b, std::size_t max_pairs,
                                           const Limits& limits) {
  GROVE_ASSERT(!a.empty() && !b.empty(), "both agents have a path");
  a_ = &a;
  b_ = &b;
  max_pairs_ = max_pairs;
  find_contacts();
  if (first_contact_ == kNever) return Dependence::kIndependent;
  if (first_contact_ == 0) return Dependence::kDependent;  // they start on the same place
  known_.clear();
  const Time before = first_contact_ - 1;
  const Range of_a = nodes_at(a, before);
  const Range of_b = nodes_at(b, before);
  for (NodeId i = of_a.first; i < of_a.end; ++i)
    for (NodeId j = of_b.first; j < of_b.end; ++j) {
      const Dependence result = search({i, j, before}, limits);
      if (result != Dependence::kDependent) return result;
    }
  return Dependence::kDependent;
}

void JointMddSearch::Workspace::find_contacts() {
  first_contact_ = kNever;
  last_contact_ = -1;
  const Time end = std::max(a_->cost(), b_->cost());
  for (Time time = 0; time <= end; ++time) {
    const Range nodes = nodes_at(*a_, time);
    for (NodeId node = nodes.first; node < nodes.end; ++node)
      seen_[time % 2][a_->place(node)] = stamp_ + time;
    if (!is_contact(time)) continue;
    first_contact_ = std::min(first_contact_, time);
    last_contact_ = time;
  }
  stamp_ += end + 1;
}

bool JointMddSearch::Workspace::is_contact(Time time) const {
  bool entered = false;
  const Range now = nodes_at(*b_, time);
  for (NodeId node = now.first; node < now.end; ++node) {
    if (seen_at(b_->place(node), time)) return true;
    entered = entered || (time > 0 && seen_at(b_->place(node), time - 1));
  }
  if (!entered) return false;
  const Range before = nodes_at(*b_, time - 1);
  for (NodeId node = before.first; node < before.end; ++node)
    if (seen_at(b_->place(node), time)) return true;
  return false;
}

// Returns kDependent if no pair in the layer of the last contact is reachable from `first` through
// pairs that were not known before.
Dependence JointMddSearch::Workspace::search(Pair first, const Limits& limits) {
  open_.clear();
  if (!known_.insert(first.a, first.b)) return Dependence::kDependent;
  open_.push_back(first);
  while (!open_.empty()) {
    const Pair pair = open_.back();
    open_.pop_back();
    if (pair.time >= last_contact_) return Dependence::kIndependent;
    if (known_.size() > max_pairs_) return Dependence::kUnknown;
    if (++expanded_ % kPairsPerPoll == 0 && limits.stop_requested()) return Dependence::kUnknown;
    expand(pair);
  }
  return Dependence::kDependent;
}

void JointMddSearch::Workspace::expand(const Pair& pair) {
  const auto next = [&](const Mdd& paths, const NodeId& node) {
    return pair.time < paths.cost() ? paths.successors(node) : std::span(&node, 1);
  };
  const Place from_a = a_->place(pair.a);
  const Place from_b = b_->place(pair.b);
  for (const NodeId i : next(*a_, pair.a))
    for (const NodeId j : next(*b_, pair.b)) {
      const Place to_a = a_->place(i);
      const Place to_b = b_->place(j);
      if (to_a == to_b || (to_a == from_b && to_b == from_a)) continue;
      GROVE_ASSERT(pair.time + 1 <= last_contact_, "pairs after the last contact are not expanded");
      if (known_.insert(i, j)) open_.push_back({i, j, pair.time + 1});
    }
}

}  // namespace grove::detail
