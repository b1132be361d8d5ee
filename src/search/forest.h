// SPDX-License-Identifier: MIT
// Where trees come from.
#pragma once

#include <cstdint>

#include "search/node.h"

namespace grove::detail {

// The trees of a run, which together hold every plan, instantiated one by one as asked. What a tree
// fixes is the policy: see sequence_forest.h and single_tree.h. Not for two threads at once;
// outlives the nodes of its trees.
class Forest {
 public:
  Forest() = default;
  Forest(const Forest&) = delete;
  Forest& operator=(const Forest&) = delete;
  virtual ~Forest() = default;

  // A proven lower bound on every plan of every tree not yet instantiated; kInfiniteCost when all
  // are.
  virtual Cost next_bound() const = 0;
  // The root of the next tree; null when there is none or a limit struck.
  virtual NodePtr next_root() = 0;

  // Sequencing problems solved so far.
  virtual std::int64_t rtsp_calls() const = 0;
};

}  // namespace grove::detail
