// SPDX-License-Identifier: MIT
// What a few agents cost more together than alone, from wherever they are.
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

// A pattern database (Culberson and Schaeffer 1998) over two or three agents. Immutable.
class PatternDatabase {
 public:
  using Node = AgentGraph::Node;
  static constexpr std::uint8_t kUnreachable = 255;

  // `members`, rising, of `agents`. entries() is what it will hold, in bytes; making it takes
  // work(). None: stopped.
  static std::optional<PatternDatabase> make(const Instance& instance,
                                             std::span<const AgentGraph> agents,
                                             std::vector<std::size_t> members,
                                             const Limits& limits);
  static std::size_t entries(std::span<const AgentGraph> agents,
                             std::span<const std::size_t> members);
  static std::int64_t work(std::span<const AgentGraph> agents,
                           std::span<const std::size_t> members);

  const std::vector<std::size_t>& members() const { return members_; }
  // By the nodes of all agents: at least so much more, 254 at most; kUnreachable: from there they
  // do not all come to rest.
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
