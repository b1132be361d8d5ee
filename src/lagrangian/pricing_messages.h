// SPDX-License-Identifier: MIT
// What one process asks another for: the prices of some agents. Values.
#pragma once

#include <cstdint>
#include <vector>

#include "lagrangian/multipliers.h"

namespace grove::detail {

struct PricingRequest {
  std::int64_t round = 0;
  std::int32_t first = 0;         // agent
  std::vector<ScaledCost> known;  // as in PricingJob, by agent from the first one on
  MultiplierUpdate news;          // of the round's tariff, since this one was asked last
};

struct PricingReply {
  std::int64_t round = 0;    // that was asked for
  std::uint64_t digest = 0;  // of the tariff under which all were found
  std::int32_t first = 0;
  std::vector<ScaledCost> prices;
  std::vector<Path> paths;  // empty: there is none cheaper than that which is known
  std::int64_t work = 0;
};

}  // namespace grove::detail
