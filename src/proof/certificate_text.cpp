// SPDX-License-Identifier: MIT
#include "proof/certificate_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "io/input_error.h"
#include "proof/certificate_file.h"
#include "proof/certificate_reader.h"

namespace grove::detail {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 24;

std::string text_of(const std::filesystem::path& path) {
  CertificateBytes bytes(path);
  std::string text;
  char block[1 << 16];
  while (const std::size_t count = bytes.read(block, sizeof block)) {
    text.append(block, count);
    if (text.size() > kMaxBytes)
      throw InputError(path.string(), "",
                       fmt::format("is too large to be shown; expected a certificate of at "
                                   "most {} bytes, uncompressed",
                                   kMaxBytes));
  }
  return text;
}

// Collects the bound and the following rule, and counts splits.
class Summary : public CertificateVisitor {
 public:
  explicit Summary(CertificateText& read) : read_(read) {}
  std::int64_t splits = 0;

  void following(bool may_follow) override { read_.may_follow = may_follow; }
  void theorem(Cost bound) override { read_.bound = bound; }
  void split(const CertificateConstraint& /*one*/,
             const CertificateConstraint& /*other*/) override {
    ++splits;
  }
  void later(const CertificateLate& /*one*/, const CertificateLate& /*other*/,
             LemmaNumber /*lemma*/) override {
    ++splits;
  }

 private:
  CertificateText& read_;
};

}  // namespace

CertificateText read_certificate(const std::filesystem::path& path, const Instance& instance,
                                 std::int64_t max_splits) {
  CertificateText read;
  read.lines = text_of(path);
  Summary summary(read);
  std::string_view left = read.lines;
  const ByteSource bytes = [&](char* buffer, std::size_t size) {
    const std::size_t count = left.copy(buffer, size);
    left.remove_prefix(count);
    return count;
  };
  read_certificate_lines(path.string(), bytes, &instance, summary);
  if (summary.splits > max_splits)
    throw InputError(path.string(), "",
                     fmt::format("has {} splits; expected at most {}", summary.splits, max_splits));
  return read;
}

}  // namespace grove::detail
