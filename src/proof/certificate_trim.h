// SPDX-License-Identifier: MIT
// Certificates without what their theorem does not need.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>

namespace grove::detail {

// Of a certificate's file, before and after.
struct CertificateSizes {
  std::int64_t lines = 0;  // uncompressed
  std::int64_t bytes = 0;
};
struct TrimmedCertificate {
  CertificateSizes before;
  CertificateSizes after;
};

// Reads one, of anybody and any instance, and writes what of it proves the theorem: to the same
// file or another, whole or not at all, compressed if it was. If it was proven, it still is. Throws
// InputError. Reads the file three times, and holds a byte for each split, all lemmas but for their
// proofs, and what is demanded on the way down to where it is. Throws InputError too when this
// process then holds more than `memory` bytes: a few compressed bytes can be any number of lines.
TrimmedCertificate trim_certificate(const std::filesystem::path& from,
                                    const std::filesystem::path& to,
                                    std::size_t memory = std::numeric_limits<std::size_t>::max());

}  // namespace grove::detail
