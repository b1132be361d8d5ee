// SPDX-License-Identifier: MIT
// Contents of proof logs, indexed by constraint-tree node: the reasons for the bounds of a search.
// Also selects the lemmas that a leaf needs from those that it could name.
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
  Cost bound = 0;  // `cost` plus the excess that lemmas prove
  std::vector<ProofExcess> excesses;
  std::optional<ProofSplit> split;
  std::optional<Cost> value;  // the bound that the node proves; set by SplitTree::value()
};

using ProofEntries = std::unordered_map<ProofKey, ProofEntry>;

// All records of the logs that are replayed to it. For each lemma it stores only the key. One
// thread at a time.
class ProofRecords : public ProofLog {
 public:
  ProofEntries entries;
  std::unordered_set<ProofKey> lemmas;
  std::vector<ProofTree> trees;
  Cost pricing_bound = 0;  // bound proven by `prices`
  std::vector<RowMultiplier> priced_rows;
  Cost joint_bound = 0;  // bound proven by joint search
  Cost of_formula = 0;   // bound proven by a formula

  void tree(const ProofTree& tree) override;
  void split(const ProofSplit& split) override;
  void bound(ProofKey node, Cost cost, Cost bound, std::span<const ProofExcess> excesses) override;
  void lemma(const ProofLemma& lemma, ProofKey root, std::span<const ProofSplit> splits) override;
  void prices(Cost bound, std::span<const RowMultiplier> rows) override;
  void joint(Cost bound) override;
  void formula(FormulaKind kind, std::span<const std::int64_t> numbers) override;
  void formula_bound(Cost bound) override;

  // Removes splits and excesses that name missing lemmas, and lowers the bounds of the nodes
  // accordingly. A lemma is missing if the log of its process is incomplete or was removed.
  void drop_records_without_lemmas();
};

// Default effort limit of covered() and remove_redundant().
inline constexpr std::int64_t kCoveringSteps = 100'000;
// Returns a lower bound on the excess that `excesses` together imply (search/covering.h). `steps`
// limits the effort. With 0 steps it only adds excesses of groups without a common agent.
Cost covered(std::span<const ProofExcess> excesses, std::int64_t steps = kCoveringSteps);

// Removes, from the last to the first, each excess without which the remaining ones imply at least
// `wanted`.
void remove_redundant(std::vector<ProofExcess>& excesses, Cost wanted,
                      std::int64_t steps = kCoveringSteps);

}  // namespace grove::detail
