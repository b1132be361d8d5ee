// SPDX-License-Identifier: MIT
// Joint MDD search: decides whether two agents have paths in their MDDs that do not collide.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "model/limits.h"
#include "planning/mdd.h"

namespace grove::detail {

// Result for two agents and their MDDs. If the MDDs hold all optimal paths under the agents'
// constraints, kDependent proves that two paths that satisfy the constraints and do not collide
// cost together at least 1 more than the sum of the two optima.
enum class Dependence : std::uint8_t {
  kIndependent,  // some path of a and some path of b do not collide
  kDependent,    // proven: every path of a collides with every path of b
  kUnknown,      // `max_pairs` was exceeded or a limit was reached
};

// Decides by a joint search over two MDDs whether two agents depend on each other, as in CBS with
// the WDG heuristic (Li et al., IJCAI 2019), but depth-first. The proof is at the head of
// joint_mdd_search.cpp. One thread at a time. Reuse the object, because it keeps its workspace.
class JointMddSearch {
 public:
  // `world` must outlive this object.
  explicit JointMddSearch(const World& world);
  ~JointMddSearch();

  // `a` and `b` must not be empty. They may differ in length: an agent rests on its last place
  // forever. The search stops with kUnknown at a limit or after it has generated more than
  // `max_pairs` pairs of nodes.
  Dependence find(const Mdd& a, const Mdd& b, std::size_t max_pairs, const Limits& limits);

  // Pairs of nodes expanded by all calls so far.
  std::int64_t pairs() const;

 private:
  class Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace grove::detail
