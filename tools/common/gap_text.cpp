// SPDX-License-Identifier: MIT
#include "tools/common/gap_text.h"

#include <fmt/format.h>

namespace grove::detail {

std::string gap_text(std::optional<Cost> cost, Cost lower_bound) {
  if (!cost) return "-";
  if (*cost == lower_bound) return "0.00 %";
  if (lower_bound <= 0) return "infinite";
  return fmt::format("{:.2f} %", 100.0 * static_cast<double>(*cost - lower_bound) /
                                     static_cast<double>(lower_bound));
}

}  // namespace grove::detail
