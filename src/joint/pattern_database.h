// SPDX-License-Identifier: MIT
// Pattern database: the excess of the joint cost of a few agents over their individual costs, for
// all joint nodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "joint/agent_graph.h"
#include "model/limits.h"

namespace grove::detail {

// Pattern database (Culberson and Schaeffer 1998) over two or three agents. Immutable: any thread
// may read it.
class PatternDatabase {
 public:
  using Node = AgentGraph::Node;
  static constexpr std::uint8_t kUnreachable = 255;

  // `members`: positions in `agents`, ascending. make(): makes the database for these agents;
  // returns nullopt if a limit was reached. entries(): its size in bytes. work(): the effort of
  // making it, in the unit of model/effort.h.
  static std::optional<PatternDatabase> make(const Instance& instance,
                                             std::span<const AgentGraph> agents,
                                             std::vector<std::size_t> members,
                                             const Limits& limits);
  static std::size_t entries(std::span<const AgentGraph> agents,
                             std::span<const std::size_t> members);
  static std::int64_t work(std::span<const AgentGraph> agents,
                           std::span<const std::size_t> members);

  const std::vector<std::size_t>& members() const { return members_; }
  // Lower bound on the excess of the members at `nodes` (one per element of `agents`), at most 254.
  // kUnreachable: the members cannot all come to rest from there.
  std::uint8_t excess(const Node* nodes) const {
    std::size_t entry = 0;
    for (std::size_t i = 0; i < members_.size(); ++i) entry += nodes[members_[i]] * strides_[i];
    return excess_[entry];
  }

 private:
  explicit PatternDatabase(std::vector<std::size_t> members)
      : members_(std::move(members)), strides_(members_.size(), 1) {}

  std::vector<std::size_t> members_;
  std::vector<std::size_t> strides_;
  std::vector<std::uint8_t> excess_;
};

}  // namespace grove::detail
