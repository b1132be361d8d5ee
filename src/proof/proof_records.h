// SPDX-License-Identifier: MIT
// Contents of proof logs, indexed by node: why the bounds of the searches hold.
#pragma once

#include <optional>
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
  void drop_what_lacks_lemmas();
};

}  // namespace grove::detail
