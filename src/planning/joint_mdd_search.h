// SPDX-License-Identifier: MIT
// Can two agents both have a path of their set without a collision between them?
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "model/limits.h"
#include "planning/mdd.h"

namespace grove::detail {

// Of two agents with the paths they may take: with all optimal ones under their constraints,
// kDependent proves that any two paths that obey the constraints and do not collide cost at least
// one more than the two optima together.
enum class Dependence : std::uint8_t {
  kIndependent,  // some path of the one and some path of the other do not collide
  kDependent,    // proven: all pairs collide
  kUnknown,      // a limit struck
};

// The joint search of two MDDs of CBS with WDG heuristics (Li et al., IJCAI 2019). The proof is at
// the head of pair_dependency.cpp. Holds the workspace of one thread: reuse it, do not share it.
class JointMddSearch {
 public:
  // `world` must outlive this.
  explicit JointMddSearch(const World& world);
  ~JointMddSearch();

  // Neither may be empty; they may differ in length: an agent rests on its last place for ever.
  // Looks at `most_pairs` pairs of nodes at most.
  Dependence find(const Mdd& a, const Mdd& b, std::size_t most_pairs, const Limits& limits);

  // Pairs of nodes looked at so far.
  std::int64_t pairs() const;

 private:
  class Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace grove::detail
