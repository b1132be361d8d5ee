// SPDX-License-Identifier: MIT
// Options of the constraint-tree search.
#pragma once

#include <cstdint>

#include "model/tuning.h"
#include "search/techniques.h"

namespace grove::detail {

class ProofLog;  // search/proof_log.h

struct SearchOptions {
  Techniques techniques;
  std::uint64_t seed = 0;  // breaks ties where the earliest conflict is chosen
  // Checks every expanded node, and the tables kept from node to node, against recomputed values
  // (audit.h). The search then takes several times as long.
  bool audit = false;
  Tuning tuning = {};
  ProofLog* proof = nullptr;  // sink of the certificate; nullptr: none
  // The number of labels that a low-level call expands does not depend on earlier calls. This is
  // slower if agents have many tasks.
  bool repeatable = false;
};

}  // namespace grove::detail
