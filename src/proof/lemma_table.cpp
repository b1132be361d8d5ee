// SPDX-License-Identifier: MIT
// Which lemmas a leaf needs.
//
// A leaf is proven by lemmas alone if agents that cost at least 0 each, and in groups at least what
// the lemmas say, cost enough together. This is a covering problem, as where a search chooses the
// lemmas to name (proof_records.h), with only the lower bound 0 on each agent. Only lemmas without
// a common agent are added up here, because every checker finds that sum.
//
// If the costs of agents are needed too, a leaf does not need a lemma that another one implies: a
// lemma of a subset of its agents with a bound that is no less. The cost of the other agents is at
// least 0, so if c + x of the smaller group is enough, that of the larger group is.
#include "proof/lemma_table.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "proof/proof_records.h"

namespace grove::detail {
namespace {

// If a leaf names more lemmas than this, all are assumed to be needed, because each lemma is
// compared with each other one.
constexpr std::size_t kMaxNames = 1000;
constexpr std::int64_t kNoSteps = 0;

}  // namespace

bool LemmaTable::Before::operator()(LemmaNumber a, LemmaNumber b) const {
  const auto key = [&](LemmaNumber lemma) {
    return std::tie(table.lemmas_[lemma].agents, table.lemmas_[lemma].constraints);
  };
  return key(a) < key(b);
}

void LemmaTable::add(TableLemma lemma) {
  const auto number = static_cast<LemmaNumber>(lemmas_.size());
  lemma.same_as = number;
  lemmas_.push_back(std::move(lemma));
  const auto [same, is_new] = distinct_.insert(number);
  if (is_new) return;
  if (lemmas_[*same].bound >= lemmas_[number].bound) {
    lemmas_[number].same_as = *same;
  } else {
    distinct_.erase(same);
    distinct_.insert(number);
  }
}

LemmaTable::Leaf LemmaTable::leaf(std::span<const LemmaNumber> named, Cost bound) const {
  Leaf leaf{worth_naming(named), false};
  if (leaf.names.size() > kMaxNames) return leaf;
  // Lemmas with most constraints are removed first.
  std::ranges::stable_sort(leaf.names, {},
                           [&](LemmaNumber name) { return lemmas_[name].constraints.size(); });
  std::vector<ProofExcess> excesses;
  Cost sum = 0;
  for (const LemmaNumber name : leaf.names) {
    excesses.push_back({name, lemmas_[name].agents, lemmas_[name].bound});
    sum = std::min(kInfiniteCost, sum + lemmas_[name].bound);
  }
  if (sum >= bound && covered(excesses, kNoSteps) >= bound) {
    leave_out(excesses, bound, kNoSteps);
    leaf.by_lemmas = true;
    leaf.names.clear();
    for (const ProofExcess& excess : excesses)
      leaf.names.push_back(static_cast<LemmaNumber>(excess.lemma));
  }
  std::ranges::sort(leaf.names);
  if (leaf.by_lemmas) return leaf;
  const std::vector<LemmaNumber> all = leaf.names;
  std::erase_if(leaf.names, [&](LemmaNumber weaker) {
    return std::ranges::any_of(all, [&](LemmaNumber one) { return implies(one, weaker); });
  });
  return leaf;
}

// Returns the named lemmas without duplicates and without those whose bound is 0.
std::vector<LemmaNumber> LemmaTable::worth_naming(std::span<const LemmaNumber> named) const {
  std::vector<LemmaNumber> names;
  for (const LemmaNumber name : named)
    if (lemmas_[name].bound > 0) names.push_back(lemmas_[name].same_as);
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

// Whether `stronger` implies `weaker`. Of two that imply each other, only the earlier one counts as
// stronger.
bool LemmaTable::implies(LemmaNumber stronger, LemmaNumber weaker) const {
  const TableLemma& one = lemmas_[stronger];
  const TableLemma& other = lemmas_[weaker];
  if (stronger == weaker || one.bound < other.bound) return false;
  if (!std::ranges::includes(other.agents, one.agents)) return false;
  return one.bound > other.bound || one.agents != other.agents || stronger < weaker;
}

}  // namespace grove::detail
