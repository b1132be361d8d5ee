// SPDX-License-Identifier: MIT
// Contents of proof logs, indexed by node: why the bounds of the searches hold. And the choice of
// the lemmas that a leaf needs among those that it could name.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "search/proof_log.h"

namespace grove::detail {

// Record of one node.
struct ProofEntry {
  Cost cost = 0;   // sum of its agents' individual costs
  Cost bound = 0;  // `cost` plus what lemmas add
  std::vector<ProofExcess> excesses;
  std::optional<ProofSplit> split;
  std::optional<Cost> value;  // the bound that it proves
};

using ProofEntries = std::unordered_map<ProofKey, ProofEntry>;

// All records. Of lemmas only the keys are kept.
class ProofRecords : public ProofLog {
 public:
  ProofEntries entries;
  std::unordered_set<ProofKey> lemmas;
  std::vector<ProofTree> trees;
  Cost priced = 0;  // bound proven by `prices`
  std::vector<RowMultiplier> priced_rows;
  Cost joined = 0;  // bound proven by joint search

  void tree(const ProofTree& tree) override;
  void split(const ProofSplit& split) override;
  void bound(ProofKey node, Cost cost, Cost bound, std::span<const ProofExcess> excesses) override;
  void lemma(const ProofLemma& lemma, ProofKey root, std::span<const ProofSplit> splits) override;
  void prices(Cost bound, std::span<const RowMultiplier> rows) override;
  void joint(Cost bound) override;

  // Removes records that name lemmas that are missing, because a process was killed before it wrote
  // them.
  void drop_records_without_lemmas();
};

// Returns the excess that `excesses` imply together (search/covering.h). `steps` limits the effort.
// With 0 steps it only adds statements without a common agent.
inline constexpr std::int64_t kCoveringSteps = 100'000;
Cost covered(std::span<const ProofExcess> excesses, std::int64_t steps = kCoveringSteps);

// Removes excesses one after another, the last ones first, as long as the rest covers `wanted`.
void leave_out(std::vector<ProofExcess>& excesses, Cost wanted,
               std::int64_t steps = kCoveringSteps);

}  // namespace grove::detail
