// SPDX-License-Identifier: MIT
// How constraint trees are searched.
#pragma once

#include <cstdint>

#include "model/tuning.h"
#include "search/techniques.h"

namespace grove::detail {

class ProofLog;  // grove/search/proof_log.h

struct SearchOptions {
  Techniques techniques;
  std::uint64_t seed = 0;  // breaks ties among conflicts
  // Checks every node that is looked at, and the tables kept from node to node, against what they
  // stand for (audit.h). Costs several times what the search does.
  bool audit = false;
  Tuning tuning = {};
  ProofLog* proof = nullptr;  // where to write down why bounds hold; null: nowhere
  // The work for a node, and its counts, do not depend on the nodes before. Slower with many tasks.
  bool repeatable = false;
};

}  // namespace grove::detail
