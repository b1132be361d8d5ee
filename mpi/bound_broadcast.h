// SPDX-License-Identifier: MIT
// How what one rank finds out comes to all others.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mpi/messages.h"
#include "search/learned_bounds.h"

namespace grove::detail {

// What a rank has to tell of what was found out, here or by others. Each fact comes to each rank
// once, by at most log2 of them others: whoever has to tell it to the next n ranks tells it to the
// one in the middle, which tells it to the further half, and goes on with the nearer half. It says
// the most worthwhile first and no more than ranks can bear; what waits too long is never said. So
// it is of use, and nothing may depend on it. Of one thread.
class BoundBroadcast {
 public:
  struct OutgoingMessage {
    int to;
    message::LearnedBounds facts;
  };

  // `rate`: bytes per second that it may tell in the first second, and less and less after it; 0:
  // nothing.
  BoundBroadcast(int rank, int ranks, double rate) : rank_(rank), ranks_(ranks), rate_(rate) {}

  bool is_on() const { return ranks_ > 1 && rate_ > 0; }

  // One that was found out here. Those of more than a thousand bytes are not told.
  void add(const LearnedBound& fact);
  // One, packed, of this worth, that the next `reach` - 1 ranks are to be told.
  void add(double utility, std::string fact, int reach);

  // What is to be said now, in seconds since the beginning.
  std::vector<OutgoingMessage> due(double now);
  // When there may be something; infinity: unless something is added, never.
  double next_send_time() const {
    return waiting_.empty() ? std::numeric_limits<double>::infinity() : next_;
  }

 private:
  struct Piece {
    double utility;
    std::shared_ptr<const std::string> fact;
    friend bool operator<(const Piece& a, const Piece& b) { return a.utility < b.utility; }
  };
  using Waiting = std::vector<Piece>;  // a heap

  static void add(const Piece& piece, Waiting& waiting);
  double rate_at(double now) const;
  message::LearnedBounds best_of(Waiting& waiting, double bytes, int reach);

  const int rank_;
  const int ranks_;
  const double rate_;
  double next_ = 0;
  double last_ = 0;
  double allowance_ = 0;            // bytes
  std::map<int, Waiting> waiting_;  // by the reach of whoever tells; none is empty
};

}  // namespace grove::detail
