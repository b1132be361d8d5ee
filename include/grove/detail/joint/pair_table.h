// SPDX-License-Identifier: MIT
// What two agents cost more together than alone, from every pair of nodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "grove/detail/joint/agent_graph.h"

namespace grove::detail {

// A pattern database (Culberson and Schaeffer 1998) over two agents. Immutable.
class PairTable {
 public:
  static constexpr std::uint8_t kNoWay = 255;
  static constexpr std::size_t kMostPairs = std::size_t{1} << 22;

  // None: there would be more than kMostPairs pairs.
  static std::optional<PairTable> make(const Instance& instance, const AgentGraph& a,
                                       const AgentGraph& b);

  // At least so much more, 254 at most; kNoWay: from there they do not both come to rest.
  std::uint8_t excess(AgentGraph::Node a, AgentGraph::Node b) const {
    return excess_[a * width_ + b];
  }

 private:
  std::size_t width_ = 0;
  std::vector<std::uint8_t> excess_;
};

}  // namespace grove::detail
