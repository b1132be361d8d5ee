// SPDX-License-Identifier: MIT
// Streaming parser of certificates. It enforces the grammar of docs/proof.md, section 3, but does
// not check that the certificate proves anything.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "model/instance.h"
#include "model/omega.h"
#include "proof/line_stream.h"

namespace grove::detail {

// A constraint in a certificate (docs/proof.md, section 2).
struct CertificateConstraint {
  enum class Kind : std::uint8_t { kVertexOrEdge, kMove, kNoRest, kRest, kPass, kStop, kNoStop };
  static constexpr std::int32_t kForEver = -1;

  AgentIndex agent = 0;
  Kind kind = Kind::kVertexOrEdge;
  // kStop and kNoStop: p is the position of the stop, q its task. Others: p and q are the places,
  // in the order of the line. kNoRest and kRest: both `begin` and `end` are the time.
  std::int32_t p = 0;
  std::int32_t q = 0;
  std::int32_t begin = 0;
  std::int32_t end = 0;  // inclusive, or kForEver

  friend auto operator<=>(const CertificateConstraint&, const CertificateConstraint&) = default;
};

// One side of "later".
struct CertificateLate {
  AgentIndex agent = 0;
  std::int32_t time = 0;
};

using LemmaNumber = std::uint32_t;

// Callbacks of the parser: line() for each line, then the callback for its content.
class CertificateVisitor {
 public:
  virtual ~CertificateVisitor() = default;

  virtual void line(std::string_view /*text*/) {}
  virtual void head() {}  // one of the first three lines
  virtual void following(bool /*may_follow*/) {}
  // A lemma begins. The callbacks up to proven() belong to it.
  virtual void lemma(Cost /*bound*/, std::span<const AgentIndex> /*agents*/) {}
  virtual void constraint(const CertificateConstraint& /*of_lemma*/) {}
  virtual void theorem(Cost /*bound*/) {}
  virtual void split(const CertificateConstraint& /*one*/, const CertificateConstraint& /*other*/) {
  }
  virtual void later(const CertificateLate& /*one*/, const CertificateLate& /*other*/,
                     LemmaNumber /*lemma*/) {}
  virtual void leaf(std::span<const LemmaNumber> /*lemmas*/) {}
  virtual void joint() {}
  virtual void prices() {}
  virtual void row(std::int64_t /*charge*/) {}
  virtual void rows_end() {}
  virtual void formula() {}
  virtual void formula_line() {}
  virtual void formula_end() {}
  virtual void proven() {}
  virtual void end() {}
};

// Parses a certificate. If `instance` is not nullptr, checks that the certificate has the checksum
// of this instance, that the agents, places and tasks in it exist, and that each agent of "later"
// has a goal. Buffers the current line and some text after it. Throws InputError, whose message
// names `file`.
void read_certificate_lines(const std::string& file, ByteSource bytes, const Instance* instance,
                            CertificateVisitor& visitor);

}  // namespace grove::detail
