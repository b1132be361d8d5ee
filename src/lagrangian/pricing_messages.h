// SPDX-License-Identifier: MIT
// Pricing messages between processes: the request for subproblem values of several agents, and the
// reply. Values.
#pragma once

#include <cstdint>
#include <vector>

#include "lagrangian/multipliers.h"

namespace grove::detail {

struct PricingRequest {
  std::int64_t round = 0;
  std::int32_t first = 0;         // first agent
  std::vector<ScaledCost> known;  // as in PricingJob, from agent `first` on
  MultiplierUpdate news;          // changes of the multipliers since the helper's last request
};

struct PricingReply {
  std::int64_t round = 0;    // of the request
  std::uint64_t digest = 0;  // of the multipliers under which all values were computed
  std::int32_t first = 0;
  std::vector<ScaledCost> prices;
  std::vector<Path> paths;  // empty: no path cheaper than the known one was found
  std::int64_t work = 0;
};

}  // namespace grove::detail
