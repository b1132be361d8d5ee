// SPDX-License-Identifier: MIT
// Certificates without what their theorem does not need.
#pragma once

#include <cstdint>
#include <filesystem>

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
// proofs, and what is demanded on the way down to where it is.
TrimmedCertificate trim_certificate(const std::filesystem::path& from,
                                    const std::filesystem::path& to);

}  // namespace grove::detail
