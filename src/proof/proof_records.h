// SPDX-License-Identifier: MIT
// What searches wrote down of why their bounds hold, by what it speaks of.
#pragma once

#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "search/proof_log.h"

namespace grove::detail {

// What is known of a node by its name.
struct ProofEntry {
  Cost cost = 0;   // of its agents, each by itself
  Cost bound = 0;  // with what lemmas add
  std::vector<ProofExcess> excesses;
  std::optional<ProofSplit> split;
  std::optional<Cost> value;  // that it proves
};

using ProofEntries = std::unordered_map<ProofKey, ProofEntry>;

// All of it, but for the lemmas, of which only the names are kept.
class ProofRecords : public ProofLog {
 public:
  ProofEntries entries;
  std::unordered_set<ProofKey> lemmas;
  std::vector<ProofTree> trees;
  Cost priced = 0;  // what prices say, and joint search
  std::vector<RowMultiplier> priced_rows;
  Cost joined = 0;

  void tree(const ProofTree& tree) override;
  void split(const ProofSplit& split) override;
  void bound(ProofKey node, Cost cost, Cost bound, std::span<const ProofExcess> excesses) override;
  void lemma(const ProofLemma& lemma, ProofKey root, std::span<const ProofSplit> splits) override;
  void prices(Cost bound, std::span<const RowMultiplier> rows) override;
  void joint(Cost bound) override;

  // Takes out what names lemmas that are not there: a process was killed over them.
  void drop_what_lacks_lemmas();
};

}  // namespace grove::detail
