// SPDX-License-Identifier: MIT
// Selects the lemmas that a leaf needs.
//
// Lemmas alone prove a leaf if the sum of the agents' costs is at least the leaf's bound for all
// non-negative costs that satisfy the lemmas. This is a covering problem (search/covering.h). Here
// only the bounds of lemmas without a common agent are added, because every checker finds that sum.
//
// If a leaf also needs the costs of agents, it does not need a lemma that another named lemma
// implies. A lemma implies another one if its agents are a subset and its bound is no less: the
// other agents cost at least 0, so if the smaller group costs at least this bound, so does the
// larger one.
#include "proof/lemma_table.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "model/assert.h"
#include "proof/proof_records.h"

namespace grove::detail {
namespace {

// If a leaf names more lemmas than this, it keeps all of them, because comparing each pair would
// take too long.
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
  GROVE_CHECK(std::ranges::is_sorted(lemma.constraints),
              "the constraints of a lemma are in ascending order");
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
  // remove_redundant() removes the last lemmas first, which are those with the most constraints.
  std::ranges::stable_sort(leaf.names, {},
                           [&](LemmaNumber name) { return lemmas_[name].constraints.size(); });
  std::vector<ProofExcess> excesses;
  Cost sum = 0;
  for (const LemmaNumber name : leaf.names) {
    excesses.push_back({name, lemmas_[name].agents, lemmas_[name].bound});
    sum = std::min(kInfiniteCost, sum + lemmas_[name].bound);
  }
  if (sum >= bound && covered(excesses, kNoSteps) >= bound) {
    remove_redundant(excesses, bound, kNoSteps);
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
  GROVE_CHECK(all.empty() || !leaf.names.empty(), "lemmas do not all imply each other");
  return leaf;
}

// Returns the named lemmas, each replaced by its `same_as`, without duplicates and without those
// whose bound is 0.
std::vector<LemmaNumber> LemmaTable::worth_naming(std::span<const LemmaNumber> named) const {
  std::vector<LemmaNumber> names;
  for (const LemmaNumber name : named)
    if (lemmas_[name].bound > 0) names.push_back(lemmas_[name].same_as);
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  GROVE_ASSERT(
      std::ranges::all_of(names, [&](LemmaNumber name) { return lemmas_[name].same_as == name; }),
      "a leaf names the lemma that implies all others with the same statement");
  return names;
}

// True if `stronger` implies `weaker`. If two lemmas imply each other, only the earlier one counts
// as stronger.
bool LemmaTable::implies(LemmaNumber stronger, LemmaNumber weaker) const {
  const TableLemma& one = lemmas_[stronger];
  const TableLemma& other = lemmas_[weaker];
  if (stronger == weaker || one.bound < other.bound) return false;
  if (!std::ranges::includes(other.agents, one.agents)) return false;
  return one.bound > other.bound || one.agents != other.agents || stronger < weaker;
}

}  // namespace grove::detail
