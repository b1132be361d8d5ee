// SPDX-License-Identifier: MIT
// The lemmas of a certificate without their proofs, and the selection of the lemmas that a leaf
// needs.
#pragma once

#include <deque>
#include <functional>
#include <set>
#include <span>
#include <vector>

#include "proof/certificate_reader.h"

namespace grove::detail {

// A lemma without its proof.
struct TableLemma {
  std::vector<AgentIndex> agents;
  Cost bound = 0;
  std::vector<CertificateConstraint> constraints;  // ascending; at least those its proof needs
  LemmaNumber same_as = 0;  // an earlier lemma that implies this one, or this one
};

class LemmaTable {
 public:
  LemmaTable() = default;
  LemmaTable(const LemmaTable&) = delete;
  LemmaTable& operator=(const LemmaTable&) = delete;

  // Appends a lemma.
  void add(TableLemma lemma);
  const TableLemma& operator[](LemmaNumber number) const { return lemmas_[number]; }
  std::size_t size() const { return lemmas_.size(); }

  // The lemmas that a leaf should name, ascending. `by_lemmas`: they are known to prove its bound
  // for any costs of agents.
  struct Leaf {
    std::vector<LemmaNumber> names;
    bool by_lemmas = false;
  };
  Leaf leaf(std::span<const LemmaNumber> named, Cost bound) const;

 private:
  struct Before {
    const LemmaTable& table;
    bool operator()(LemmaNumber a, LemmaNumber b) const;
  };

  std::vector<LemmaNumber> worth_naming(std::span<const LemmaNumber> named) const;
  bool implies(LemmaNumber stronger, LemmaNumber weaker) const;

  std::deque<TableLemma> lemmas_;
  std::set<LemmaNumber, Before> distinct_{Before{*this}};  // ordered by agents and constraints
};

}  // namespace grove::detail
