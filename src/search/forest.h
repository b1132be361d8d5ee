// SPDX-License-Identifier: MIT
// Interface for the creation of the constraint trees of a run.
#pragma once

#include <cstdint>

#include "search/node.h"

namespace grove::detail {

// The constraint trees of a run, which are instantiated one by one on request. Together they hold
// every plan. The implementation decides what a tree fixes (sequence_forest.h, route_forest.h,
// single_tree.h). Must outlive the nodes of its trees. One thread at a time.
class Forest {
 public:
  Forest() = default;
  Forest(const Forest&) = delete;
  Forest& operator=(const Forest&) = delete;
  virtual ~Forest() = default;

  // A proven lower bound on every plan of every tree not yet instantiated; kInfiniteCost if all
  // trees are instantiated.
  virtual Cost next_bound() const = 0;
  // Instantiates the next tree and returns its root. Returns nullptr if there is none or a limit
  // was reached.
  virtual NodePtr next_root() = 0;

  // Number of sequencing problems solved so far.
  virtual std::int64_t rtsp_calls() const = 0;
};

}  // namespace grove::detail
