// SPDX-License-Identifier: MIT
// Writes the lemmas that are needed from a proof log, and numbers them.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include "model/instance.h"
#include "proof/certificate_output.h"
#include "search/proof_log.h"

namespace grove::detail {

class LemmaWriter : public ProofLog {
 public:
  // All arguments must outlive this.
  LemmaWriter(const Instance& instance, const std::unordered_set<ProofKey>& needed,
              CertificateOutput& output)
      : instance_(instance), needed_(needed), output_(output) {}

  void lemma(const ProofLemma& lemma, ProofKey root, std::span<const ProofSplit> splits) override;

  void tree(const ProofTree& /*tree*/) override {}
  void split(const ProofSplit& /*split*/) override {}
  void bound(ProofKey /*node*/, Cost /*cost*/, Cost /*bound*/,
             std::span<const ProofExcess> /*excesses*/) override {}
  void prices(Cost /*bound*/, std::span<const RowMultiplier> /*rows*/) override {}
  void joint(Cost /*bound*/) override {}

  std::int64_t number(ProofKey key) const { return numbers_.at(key); }
  std::int64_t count() const { return std::ssize(numbers_); }

 private:
  const Instance& instance_;
  const std::unordered_set<ProofKey>& needed_;
  CertificateOutput& output_;
  std::unordered_map<ProofKey, std::int64_t> numbers_;
};

}  // namespace grove::detail
