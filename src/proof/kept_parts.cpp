// SPDX-License-Identifier: MIT
#include "proof/kept_parts.h"

#include "model/assert.h"
#include "proof/active_constraints.h"

namespace grove::detail {

void KeptParts::split(const CertificateConstraint& one, const CertificateConstraint& other) {
  open({{one, other}, std::nullopt});
}

void KeptParts::later(const CertificateLate& one, const CertificateLate& other, LemmaNumber lemma) {
  open({{constraint_of(one), constraint_of(other)}, lemma});
}

void KeptParts::leaf(std::span<const LemmaNumber> lemmas) {
  if (!is_skipping()) kept_leaf(lemmas);
  close();
}

void KeptParts::joint() {
  if (!is_skipping()) kept_joint();
  close();
}

void KeptParts::prices() {
  if (!is_skipping()) kept_prices();
}

void KeptParts::row(std::int64_t charge) {
  if (!is_skipping()) kept_row(charge);
}

void KeptParts::rows_end() {
  if (!is_skipping()) kept_rows_end();
  close();
}

void KeptParts::formula() {
  if (!is_skipping()) kept_formula();
}

void KeptParts::formula_line() {
  if (!is_skipping()) kept_formula_line();
}

void KeptParts::formula_end() {
  if (!is_skipping()) kept_formula_end();
  close();
}

void KeptParts::open(const Fork& fork) {
  const std::size_t number = splits_++;
  if (is_skipping()) {
    ++skipped_depth_;
    return;
  }
  levels_.push_back({number, begin_split(number, fork), false});
  begin(0);
}

void KeptParts::begin(int which) {
  GROVE_CHECK(!is_skipping() && levels_.back().has_first == (which == 1),
              "the sides of a split are visited in their order");
  if (levels_.back().keep == (which == 0 ? Keep::kSecond : Keep::kFirst))
    skipped_depth_ = 1;
  else
    begin_side(which);
}

// Ends a proof and all enclosing proofs that end at the same line.
void KeptParts::close() {
  if (is_skipping() && --skipped_depth_ > 0) return;
  while (!levels_.empty()) {
    Level& level = levels_.back();
    if (!level.has_first) {
      level.has_first = true;
      level.keep = end_first_side(level.number);
      return begin(1);
    }
    end_split(level.number);
    levels_.pop_back();
  }
}

}  // namespace grove::detail
