// SPDX-License-Identifier: MIT
// Trimming of certificates: removes what the theorem does not need.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>

namespace grove::detail {

// Sizes of a certificate, before and after.
struct CertificateSizes {
  std::int64_t lines = 0;  // uncompressed
  std::int64_t bytes = 0;
};
struct TrimmedCertificate {
  CertificateSizes before;
  CertificateSizes after;
};

// Reads a certificate, by any author and for any instance, and writes the parts that prove the
// theorem to `to`, which may equal `from`. The file is written completely or not at all, and
// compressed if `from` was. If the certificate was valid, it still is. Reads the file three times.
// Keeps in memory a byte for each split, all lemmas without their proofs, and the constraints that
// are active at the current line. Throws InputError, also if this process then holds more than
// `memory` bytes: a few compressed bytes can be any number of lines.
TrimmedCertificate trim_certificate(const std::filesystem::path& from,
                                    const std::filesystem::path& to,
                                    std::size_t memory = std::numeric_limits<std::size_t>::max());

}  // namespace grove::detail
