// SPDX-License-Identifier: MIT
// The K best sequences of one agent, computed by the partition method.
//
// Lawler (1972), after Murty (1968); Algorithm 2 of the paper, with its branches indexed from the
// start. The queue holds classes that partition the sequences that have not been returned. The best
// member s of the cheapest class is the next sequence. The class without s is split into the
// classes
//
//   the first i stops are those of s, and the next stop is not s[i]; if i is the length of the
//   prefix of the class, the next stop is also none of those that the class forbids
//
// for each position i after the prefix of the class, so every sequence is returned exactly once.
// The branch at the last position would forbid the only stop left, so it is empty and omitted.
//
// *Lazy evaluation.* A class enters the queue with only a proven lower bound, the cost of s. When
// it reaches the top, the back end is called with that bound as the cutoff. The answer is the exact
// cost or a better bound, and in both cases the class is pushed again with the answer as its key.
// Keys never exceed the optimum of their class, and the best member of a class is returned only if
// its key is exact and no key is smaller. Hence the order is correct, the key at the top is a lower
// bound on all later sequences, and the back ends prove no more than the order requires. Among
// equal keys exact classes come first, because they require no further search.
#include "sequencing/k_best_sequences.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "model/assert.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/keyed_stacks.h"
#include "sequencing/sequence.h"

namespace grove::detail {

class KBestSequences::Partition {
 public:
  Partition(std::unique_ptr<RtspSolver> solver, const CostMatrix& matrix, const Limits& limits)
      : solver_(std::move(solver)), matrix_(matrix), limits_(limits) {
    queue_.push({solver_->root_bound(), kBounded}, {0, 0, 0});
    drop_infeasible();
  }

  bool known(std::size_t rank) const { return rank < found_.size(); }

  Time cost_bound(std::size_t rank) const {
    if (known(rank)) return found_[rank].cost;
    return queue_.empty() ? kNever : queue_.top_key().first;
  }

  Time resolve(std::size_t rank, Time cutoff) {
    const Time before = cost_bound(rank);
    while (!known(rank) && !queue_.empty() && queue_.top_key().first <= cutoff)
      if (limits_.stop_requested() || !advance()) break;
    GROVE_CHECK(cost_bound(rank) >= before, "the bound on the cost of a rank never falls");
    return cost_bound(rank);
  }

  const Sequence& sequence(std::size_t rank) const { return found_[rank].sequence; }

  std::int64_t rtsp_calls() const { return rtsp_calls_; }

 private:
  enum Knowledge : std::uint8_t { kExact, kBounded };
  using Key = std::pair<Time, Knowledge>;

  // The class of sequences that begin with the first `length` stops of the sequence of rank
  // `parent` and whose next stop is not in `forbidden`.
  struct Entry {
    StopSet forbidden;
    std::uint32_t parent;
    std::uint32_t length;
  };

  struct Found {
    Time cost;
    Sequence sequence;
  };

  // Processes the top of the queue. Returns false if a limit was reached.
  bool advance() {
    const auto [bound, knowledge] = queue_.top_key();
    const Entry entry = queue_.pop();
    load(entry);
    if (knowledge == kExact) {
      GROVE_CHECK(found_.empty() || found_.back().cost <= bound,
                  "sequences are found in ascending order of cost");
      found_.push_back({bound, solver_->best_sequence(class_)});
      GROVE_ASSERT(is_member(found_.back().sequence, class_),
                   "a sequence is found in a class that contains it");
      GROVE_ASSERT(sequence_cost(matrix_, found_.back().sequence) >= bound,
                   "no sequence costs less than the bound of its class");
      GROVE_ASSERT(std::ranges::count(found_, found_.back().sequence, &Found::sequence) == 1,
                   "each sequence is found once");
      branch(entry, bound);
      return true;
    }
    ++rtsp_calls_;
    const RtspAnswer answer = solver_->best(class_, bound);
    const bool exact = answer.kind == RtspAnswer::Kind::kExact;
    if (answer.kind != RtspAnswer::Kind::kInfeasible)
      queue_.push({std::max(bound, answer.cost), exact ? kExact : kBounded}, entry);
    return answer.kind != RtspAnswer::Kind::kStopped;
  }

  bool is_member(const Sequence& sequence, const SequenceClass& sequence_class) const {
    const Sequence& prefix = sequence_class.prefix;
    return std::ssize(sequence) == matrix_.stops() && prefix.size() <= sequence.size() &&
           std::equal(prefix.begin(), prefix.end(), sequence.begin()) &&
           (prefix.size() == sequence.size() ||
            (sequence_class.forbidden_next & bit(sequence[prefix.size()])) == 0);
  }

  // Loads the class of an entry into class_, which keeps its memory.
  void load(const Entry& entry) {
    class_.forbidden_next = entry.forbidden;
    class_.prefix.clear();
    if (entry.length == 0) return;
    const Sequence& parent = found_[entry.parent].sequence;
    class_.prefix.assign(parent.begin(), parent.begin() + entry.length);
  }

  // Splits the class of the entry, without the sequence just found.
  void branch(const Entry& entry, Time cost) {
    const Sequence& sequence = found_.back().sequence;
    const auto parent = static_cast<std::uint32_t>(found_.size() - 1);
    StopSet left = matrix_.all();
    for (std::uint32_t i = 0; i < sequence.size(); ++i) {
      const StopSet forbidden = bit(sequence[i]) | (i == entry.length ? entry.forbidden : 0);
      if (i >= entry.length && (left & ~forbidden) != 0)
        queue_.push({cost, kBounded}, {forbidden, parent, i});
      left &= ~bit(sequence[i]);
    }
  }

  void drop_infeasible() {
    if (queue_.top_key().first >= kNever) queue_.pop();
  }

  std::unique_ptr<RtspSolver> solver_;
  const CostMatrix& matrix_;
  const Limits& limits_;
  KeyedStacks<Key, Entry> queue_;
  std::deque<Found> found_;  // by rank; a deque, so that references to sequences stay valid
  SequenceClass class_;
  std::int64_t rtsp_calls_ = 0;
};

KBestSequences::KBestSequences(std::unique_ptr<RtspSolver> solver, const CostMatrix& matrix,
                               const Limits& limits)
    : partition_(std::make_unique<Partition>(std::move(solver), matrix, limits)) {}
KBestSequences::~KBestSequences() = default;
KBestSequences::KBestSequences(KBestSequences&&) noexcept = default;
KBestSequences& KBestSequences::operator=(KBestSequences&&) noexcept = default;

bool KBestSequences::known(std::size_t rank) const {
  return partition_->known(rank);
}
Time KBestSequences::cost_bound(std::size_t rank) const {
  return partition_->cost_bound(rank);
}
Time KBestSequences::resolve(std::size_t rank, Time cutoff) {
  return partition_->resolve(rank, cutoff);
}
const Sequence& KBestSequences::sequence(std::size_t rank) {
  GROVE_ASSERT(known(rank), "the sequence of a rank is known before it is read");
  return partition_->sequence(rank);
}
std::int64_t KBestSequences::rtsp_calls() const {
  return partition_->rtsp_calls();
}

}  // namespace grove::detail
