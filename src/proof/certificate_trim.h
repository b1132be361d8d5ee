// SPDX-License-Identifier: MIT
// Trims certificates: removes the parts that the theorem does not need.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>

namespace grove::detail {

// Sizes of a certificate, before and after.
struct CertificateSizes {
  std::int64_t lines = 0;
  std::int64_t bytes = 0;  // of the file, compressed if it is
};
struct TrimmedCertificate {
  CertificateSizes before;
  CertificateSizes after;
};

// Reads a certificate, from any program and for any instance, and writes the parts that prove the
// theorem to `to`, which may equal `from`. `to` is written completely or not at all (special files:
// AtomicFile), and is compressed if `from` is. If the certificate in `from` is valid, the one in
// `to` is valid. Reads `from` three times. Keeps in memory one byte for each split, all lemmas with
// the names in their proofs but without these proofs, and the open splits and active constraints at
// the current line. Throws InputError, also if this process uses more than `memory` bytes, because
// a few compressed bytes can expand to any number of lines.
TrimmedCertificate trim_certificate(const std::filesystem::path& from,
                                    const std::filesystem::path& to,
                                    std::size_t memory = std::numeric_limits<std::size_t>::max());

}  // namespace grove::detail
