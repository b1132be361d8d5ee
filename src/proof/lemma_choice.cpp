// SPDX-License-Identifier: MIT
#include "proof/lemma_choice.h"

#include "search/covering.h"

namespace grove::detail {

Cost covered(std::span<const ProofExcess> excesses, std::int64_t steps) {
  std::vector<GroupExcess> statements;
  for (const ProofExcess& excess : excesses) statements.push_back({excess.agents, excess.excess});
  return statements.empty() ? 0 : covering_bound(statements, steps);
}

void leave_out(std::vector<ProofExcess>& excesses, Cost wanted, std::int64_t steps) {
  for (std::size_t i = excesses.size(); i-- > 0;) {
    std::vector<ProofExcess> rest = excesses;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    if (covered(rest, steps) >= wanted) excesses = std::move(rest);
  }
}

}  // namespace grove::detail
