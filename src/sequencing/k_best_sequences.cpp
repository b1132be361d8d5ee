// SPDX-License-Identifier: MIT
// The K best sequences of one agent by the partition method.
//
// Lawler (1972), after Murty (1968); the paper's Algorithm 2, with its branches indexed from the
// start. The queue holds classes that partition all sequences not yet returned. The best member s
// of the cheapest class is the next sequence; the class without s falls apart into
//
//   begins like s up to its i-th stop, then not s[i]   (and, at the class's own place, not what the
//                                                       class forbade there already)
//
// for each position i from the class's prefix on, so every sequence is returned exactly once. The
// branch at the last position would forbid the only stop left: it is empty and never made.
//
// Laziness: a class enters the queue with nothing but a proven lower bound, its parent's cost. Only
// when it comes to the top is the back end asked, with that bound as the cutoff; the answer is its
// exact cost or a better bound, and either way it goes back to its new place. Keys never exceed the
// true optimum of their class, and only an exact one is returned, when no key is smaller: so the
// order is right, the top's key bounds whatever comes next, and the back ends never prove more than
// the order requires. At equal keys exact classes go first: they need no more work.
#include "sequencing/k_best_sequences.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "model/assert.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/keyed_stacks.h"
#include "sequencing/stop_set.h"

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
    while (!known(rank) && !queue_.empty() && queue_.top_key().first <= cutoff)
      if (limits_.stop_requested() || !advance()) break;
    return cost_bound(rank);
  }

  const Sequence& sequence(std::size_t rank) const { return found_[rank].sequence; }

  std::int64_t rtsp_calls() const { return rtsp_calls_; }

 private:
  enum Knowledge : std::uint8_t { kExact, kBounded };
  using Key = std::pair<Time, Knowledge>;

  // A class: the first `length` stops of a sequence found, then none of `forbidden`.
  struct Entry {
    StopSet forbidden;
    std::uint32_t parent;
    std::uint32_t length;
  };

  struct Found {
    Time cost;
    Sequence sequence;
  };

  // One step on the top of the queue. False when a limit struck.
  bool advance() {
    const auto [bound, knowledge] = queue_.top_key();
    const Entry entry = queue_.pop();
    load(entry);
    if (knowledge == kExact) {
      found_.push_back({bound, solver_->best_sequence(class_)});
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

  // The class of an entry, into class_ (which keeps its memory).
  void load(const Entry& entry) {
    class_.forbidden_next = entry.forbidden;
    class_.prefix.clear();
    if (entry.length == 0) return;
    const Sequence& parent = found_[entry.parent].sequence;
    class_.prefix.assign(parent.begin(), parent.begin() + entry.length);
  }

  // Splits what is left of the entry's class without the sequence just found.
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
  std::deque<Found> found_;  // by rank; a deque, so that sequences stay where they are
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
  GROVE_ASSERT(known(rank), "a sequence is computed before it is asked for");
  return partition_->sequence(rank);
}
std::int64_t KBestSequences::rtsp_calls() const {
  return partition_->rtsp_calls();
}

}  // namespace grove::detail
