// SPDX-License-Identifier: MIT
// Visitor of a certificate that skips the removed sides of splits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "proof/certificate_reader.h"

namespace grove::detail {

// The part of a split to keep: the split with both sides, or the proof below one side in place of
// the split.
enum class Keep : std::uint8_t { kBoth, kFirst, kSecond };

// A line "split" or "later" with its two sides.
struct Fork {
  std::array<CertificateConstraint, 2> sides;
  std::optional<LemmaNumber> lemma;  // for "later": its lemma
};

class KeptParts : public CertificateVisitor {
 public:
  void split(const CertificateConstraint& one, const CertificateConstraint& other) final;
  void later(const CertificateLate& one, const CertificateLate& other, LemmaNumber lemma) final;
  void leaf(std::span<const LemmaNumber> lemmas) final;
  void joint() final;
  void prices() final;
  void row(std::int64_t charge) final;
  void rows_end() final;
  void formula() final;
  void formula_line() final;
  void formula_end() final;

 protected:
  // Called at each split that is not skipped. `number`: index of the split among all splits of the
  // certificate, including skipped ones. Returns the part to keep; kSecond skips the first side.
  virtual Keep begin_split(std::size_t number, const Fork& fork) = 0;
  virtual void begin_side(int /*which*/) {}
  // Called after the first side, even if it was skipped. Returns the part to keep; kFirst skips the
  // second side.
  virtual Keep end_first_side(std::size_t number) = 0;
  virtual void end_split(std::size_t /*number*/) {}
  virtual void kept_leaf(std::span<const LemmaNumber> lemmas) = 0;
  virtual void kept_joint() {}
  virtual void kept_prices() {}
  virtual void kept_row(std::int64_t /*charge*/) {}
  virtual void kept_rows_end() {}
  virtual void kept_formula() {}
  virtual void kept_formula_line() {}
  virtual void kept_formula_end() {}

 private:
  struct Level {
    std::size_t number;
    Keep keep;
    bool has_first;
  };

  void open(const Fork& fork);
  void begin(int which);
  void close();
  bool is_skipping() const { return skipped_depth_ > 0; }

  std::size_t splits_ = 0;
  std::deque<Level> levels_;
  std::int64_t skipped_depth_ = 0;  // number of open subproofs on the skipped side
};

}  // namespace grove::detail
