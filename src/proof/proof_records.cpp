// SPDX-License-Identifier: MIT
#include "proof/proof_records.h"

#include <algorithm>

#include "model/assert.h"
#include "search/covering.h"

namespace grove::detail {

void ProofRecords::tree(const ProofTree& tree) {
  if (std::ranges::count(trees, tree.root, &ProofTree::root) == 0) trees.push_back(tree);
}

void ProofRecords::split(const ProofSplit& split) {
  entries[split.node].split = split;
}

void ProofRecords::bound(ProofKey node, Cost cost, Cost bound,
                         std::span<const ProofExcess> excesses) {
  ProofEntry& entry = entries[node];
  entry.cost = std::max(entry.cost, cost);
  if (bound <= entry.bound) return;
  entry.bound = bound;
  entry.excesses.assign(excesses.begin(), excesses.end());
}

void ProofRecords::lemma(const ProofLemma& lemma, ProofKey /*root*/,
                         std::span<const ProofSplit> /*splits*/) {
  lemmas.insert(lemma.key());
}

void ProofRecords::prices(Cost bound, std::span<const RowMultiplier> rows) {
  if (bound <= pricing_bound) return;
  pricing_bound = bound;
  priced_rows.assign(rows.begin(), rows.end());
}

void ProofRecords::joint(Cost bound) {
  joint_bound = std::max(joint_bound, bound);
}

void ProofRecords::formula(FormulaKind /*kind*/, std::span<const std::int64_t> /*numbers*/) {}

void ProofRecords::formula_bound(Cost bound) {
  of_formula = std::max(of_formula, bound);
}

void ProofRecords::drop_records_without_lemmas() {
  const auto is_lost = [&](ProofKey lemma) { return !lemmas.contains(lemma); };
  for (auto& [node, entry] : entries) {
    if (entry.split && entry.split->lemma != kNoProof && is_lost(entry.split->lemma))
      entry.split.reset();
    const auto lost = [&](const ProofExcess& excess) { return is_lost(excess.lemma); };
    if (std::erase_if(entry.excesses, lost) > 0) entry.bound = entry.cost + covered(entry.excesses);
  }
}

Cost covered(std::span<const ProofExcess> excesses, std::int64_t steps) {
  std::vector<GroupExcess> statements;
  for (const ProofExcess& excess : excesses) statements.push_back({excess.agents, excess.excess});
  return statements.empty() ? 0 : covering_bound(statements, steps);
}

void remove_redundant(std::vector<ProofExcess>& excesses, Cost wanted, std::int64_t steps) {
  const std::size_t before = excesses.size();
  for (std::size_t i = before; i-- > 0;) {
    std::vector<ProofExcess> rest = excesses;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    if (covered(rest, steps) >= wanted) excesses = std::move(rest);
  }
  GROVE_ASSERT(excesses.size() == before || covered(excesses, steps) >= wanted,
               "the excesses that remain suffice");
}

}  // namespace grove::detail
