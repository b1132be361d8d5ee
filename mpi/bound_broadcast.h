// SPDX-License-Identifier: MIT
// Broadcast of learned bounds from each rank to all other ranks.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mpi/messages.h"
#include "search/learned_bounds.h"

namespace grove::detail {

// Sends learned bounds of this rank, and forwards learned bounds from other ranks, along a binomial
// tree. Each learned bound reaches each rank at most once, over at most ceil(log2(ranks)) hops. A
// rank that is responsible for n consecutive ranks sends to the middle one, which becomes
// responsible for the farther half, and continues with the nearer half. Bounds of the highest
// utility are sent first, at a limited rate. If too many bounds wait, the least useful ones are
// dropped, so the search must not depend on any delivery. One thread at a time.
class BoundBroadcast {
 public:
  struct OutgoingMessage {
    int to;
    message::LearnedBounds facts;
  };

  // `rate`: bytes per second that this rank may send in the first second; later the rate falls as 1
  // / time. 0: nothing is sent.
  BoundBroadcast(int rank, int ranks, double rate) : rank_(rank), ranks_(ranks), rate_(rate) {}

  bool is_on() const { return ranks_ > 1 && rate_ > 0; }

  // Adds a bound learned on this rank. A bound of more than 1,000 bytes is not sent.
  void add(const LearnedBound& fact);
  // Adds a packed bound, to be forwarded to the next `reach` - 1 ranks.
  void add(double utility, std::string fact, int reach);

  // Returns the messages to send now. `now`: seconds since the start of the run.
  std::vector<OutgoingMessage> due(double now);
  // The earliest time, in seconds since the start of the run, at which due() can return messages.
  // Infinity: not before the next add().
  double next_send_time() const {
    return waiting_.empty() ? std::numeric_limits<double>::infinity() : next_;
  }

 private:
  struct Piece {
    double utility;
    std::shared_ptr<const std::string> fact;
    friend bool operator<(const Piece& a, const Piece& b) { return a.utility < b.utility; }
  };
  using Waiting = std::vector<Piece>;  // a max-heap by utility

  static void add(const Piece& piece, Waiting& waiting);
  double rate_at(double now) const;
  message::LearnedBounds best_of(Waiting& waiting, double bytes, int reach);

  const int rank_;
  const int ranks_;
  const double rate_;
  double next_ = 0;
  double last_ = 0;
  double allowance_ = 0;            // bytes that may be sent now
  std::map<int, Waiting> waiting_;  // by the reach of this rank when it sends; no heap is empty
};

}  // namespace grove::detail
