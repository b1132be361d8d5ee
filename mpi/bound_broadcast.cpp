// SPDX-License-Identifier: MIT
// *Claim:* each rank receives a learned bound at most once. *Proof.* A rank with reach n is
// responsible for n consecutive ranks, starting with itself. With h = ceil(n / 2), it sends the
// bound, with reach n - h, to the rank at distance h, and its own reach becomes h. The two new
// ranges partition the n ranks, so no rank is in both. The recursion ends at reach 1.
#include "mpi/bound_broadcast.h"

#include <algorithm>
#include <utility>

#include "model/assert.h"
#include "mpi/polling.h"

namespace grove::detail {
namespace {

constexpr double kPause_s = 1e-3;  // minimum time between two sends, at the start; see pause_at()
constexpr double kMaxBurstPauses = 10;  // bytes can be saved up during this number of pauses
constexpr std::size_t kMaxWaiting = 1000;
// Maximum length of a bound, in bytes. A bound longer than the allowance of one call would block
// all others.
constexpr std::size_t kMaxBoundBytes = 1000;
constexpr double kMinBurstBytes = 16e3;  // at least these bytes can be saved up, for all receivers
constexpr double kFullRate_s = 1;        // after this time the rate falls as 1 / time
constexpr std::size_t kBytesOfSize = 1;  // approximate bytes of the length field of a packed bound

}  // namespace

void BoundBroadcast::add(const LearnedBound& fact) {
  add(fact.utility(), message::packed(fact), ranks_);
}

void BoundBroadcast::add(double utility, std::string fact, int reach) {
  reach = std::min(reach, ranks_);
  if (reach <= 1 || fact.size() > kMaxBoundBytes) return;
  const Piece piece{utility, std::make_shared<const std::string>(std::move(fact))};
  for (int n = reach; n > 1; n = (n + 1) / 2) add(piece, waiting_[n]);
}

void BoundBroadcast::add(const Piece& piece, Waiting& waiting) {
  waiting.push_back(piece);
  std::push_heap(waiting.begin(), waiting.end());
  if (waiting.size() <= 2 * kMaxWaiting) return;
  std::nth_element(waiting.begin(), waiting.begin() + kMaxWaiting, waiting.end(),
                   [](const Piece& a, const Piece& b) { return b < a; });
  waiting.resize(kMaxWaiting);
  std::make_heap(waiting.begin(), waiting.end());
}

std::vector<BoundBroadcast::OutgoingMessage> BoundBroadcast::due(double now) {
  std::vector<OutgoingMessage> parcels;
  if (waiting_.empty() || now < next_) return parcels;
  const double pause = pause_at(now, kPause_s);
  const double rate = rate_at(now);
  const double most = std::max(kMaxBurstPauses * pause * rate, kMinBurstBytes);
  allowance_ = std::min(allowance_ + (now - last_) * rate, most);
  last_ = now;
  next_ = now + pause;
  auto left = static_cast<double>(waiting_.size());
  // The largest reach first, because its bounds have the longest way to go.
  for (auto at = waiting_.rbegin(); at != waiting_.rend(); ++at, --left) {
    const int reach = at->first;
    const int to = (rank_ + (reach + 1) / 2) % ranks_;
    GROVE_CHECK(reach > 1 && reach <= ranks_ && to != rank_,
                "a rank sends to another rank in its reach");
    message::LearnedBounds facts = best_of(at->second, allowance_ / left, reach / 2);
    if (!facts.facts.empty()) parcels.push_back({to, std::move(facts)});
  }
  std::erase_if(waiting_, [](const auto& entry) { return entry.second.empty(); });
  return parcels;
}

// The rate falls with time. At the start all ranks search near the same nodes. Later each rank is
// in its own part of the tree, so its bounds are less useful to other ranks; moreover, caches are
// finite.
double BoundBroadcast::rate_at(double now) const {
  return rate_ * kFullRate_s / std::max(now, kFullRate_s);
}

message::LearnedBounds BoundBroadcast::best_of(Waiting& waiting, double bytes, int reach) {
  message::LearnedBounds sent{reach, {}};
  while (!waiting.empty()) {
    const std::string& best = *waiting.front().fact;
    const auto more = static_cast<double>(best.size() + kBytesOfSize);
    if (more > bytes) break;
    bytes -= more;
    allowance_ -= more;
    sent.facts.push_back(best);
    std::pop_heap(waiting.begin(), waiting.end());
    GROVE_ASSERT(waiting.back().utility >= waiting.front().utility,
                 "the most useful bounds are sent first");
    waiting.pop_back();
  }
  GROVE_CHECK(bytes >= 0, "no more bytes are sent than allowed");
  return sent;
}

}  // namespace grove::detail
