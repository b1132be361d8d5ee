// SPDX-License-Identifier: MIT
// Who gives nodes to whom.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "grove/detail/model/tuning.h"
#include "mpi/messages.h"

namespace grove::detail {

// Matches ranks that have nothing to expand, or nothing as good as others, with those that have
// most to spare. Decides nothing that an answer depends on. Of one thread.
class Broker {
 public:
  struct Gift {
    int from = 0;
    int to = 0;
    std::int64_t nodes = 0;  // at most
  };

  // Nobody has nodes yet.
  explicit Broker(int ranks, const Tuning& tuning = {});

  // A rank's new status.
  void heard(int rank, const message::Status& status);
  // A gift to this rank has arrived.
  void arrived(int rank);
  // What to order next. Until it has arrived the receiver is given nothing else.
  std::optional<Gift> next();

 private:
  using Offer = std::tuple<Cost, std::int64_t, int>;  // bound, minus nodes, rank
  using Want = std::tuple<bool, Cost, int>;           // has nodes in hand, minus bound, rank

  struct View {
    std::vector<Frontier::Level> levels;
    bool idle = true;
    bool awaits = false;  // a gift
    std::optional<Offer> offer;
    std::optional<Want> want;
  };

  View& view(int rank) { return ranks_[static_cast<std::size_t>(rank)]; }
  void place(int rank);

  const Tuning tuning_;
  std::vector<View> ranks_;
  std::set<Offer> offers_;
  std::set<Want> wants_;
};

}  // namespace grove::detail
