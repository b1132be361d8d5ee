// SPDX-License-Identifier: MIT
#include "proof/lemma_writer.h"

#include <fmt/format.h>

#include "proof/proof_text.h"
#include "proof/split_tree.h"

namespace grove::detail {

void LemmaWriter::lemma(const ProofLemma& lemma, ProofKey root,
                        std::span<const ProofSplit> splits) {
  const ProofKey key = lemma.key();
  if (!needed_.contains(key)) return;
  if (!numbers_.emplace(key, std::ssize(numbers_)).second) return;
  output_.line(fmt::format("lemma {} {}", proof_text(lemma.bound), fmt::join(lemma.agents, " ")));
  for (const AgentConstraint& demand : lemma.demands)
    output_.line("demand " + proof_text(demand, instance_));
  if (splits.empty()) return output_.line("joint");
  ProofEntries entries;
  for (const ProofSplit& split : splits) entries[split.node].split = split;
  SplitTree tree(entries);
  tree.value(root, 0);
  tree.walk(
      root, 0, lemma.bound, [&](const ProofEntry*) { output_.line("leaf"); },
      [&](const ProofEntry& entry) { output_.line(proof_text(entry.split->split, instance_)); });
}

}  // namespace grove::detail
