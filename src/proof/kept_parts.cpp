// SPDX-License-Identifier: MIT
#include "proof/kept_parts.h"

#include "proof/active_constraints.h"

namespace grove::detail {

void KeptParts::split(const CertificateConstraint& one, const CertificateConstraint& other) {
  open({{one, other}, std::nullopt});
}

void KeptParts::later(const CertificateLate& one, const CertificateLate& other, LemmaNumber lemma) {
  open({{constraint_of(one), constraint_of(other)}, lemma});
}

void KeptParts::leaf(std::span<const LemmaNumber> lemmas) {
  if (!passes_over()) kept_leaf(lemmas);
  close();
}

void KeptParts::joint() {
  if (!passes_over()) kept_joint();
  close();
}

void KeptParts::prices() {
  if (!passes_over()) kept_prices();
}

void KeptParts::row(std::int64_t charge) {
  if (!passes_over()) kept_row(charge);
}

void KeptParts::rows_end() {
  if (!passes_over()) kept_rows_end();
  close();
}

void KeptParts::open(const Fork& fork) {
  const std::size_t number = splits_++;
  if (passes_over()) {
    ++passed_over_;
    return;
  }
  levels_.push_back({number, opened(number, fork), false});
  begin(0);
}

void KeptParts::begin(int which) {
  if (levels_.back().keep == (which == 0 ? Keep::kSecond : Keep::kFirst))
    passed_over_ = 1;
  else
    begin_side(which);
}

// Ends a proof and all enclosing proofs that end at the same line.
void KeptParts::close() {
  if (passes_over() && --passed_over_ > 0) return;
  while (!levels_.empty()) {
    Level& level = levels_.back();
    if (!level.has_first) {
      level.has_first = true;
      level.keep = first_done(level.number);
      return begin(1);
    }
    second_done(level.number);
    levels_.pop_back();
  }
}

}  // namespace grove::detail
