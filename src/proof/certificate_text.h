// SPDX-License-Identifier: MIT
// Reads a whole certificate as text, for display: docs/proof.md, section 3.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "model/instance.h"
#include "model/omega.h"

namespace grove::detail {

struct CertificateText {
  std::string lines;       // all lines, uncompressed, each ended by LF
  Cost bound = 0;          // bound of the theorem; kInfiniteCost: there is no plan
  bool may_follow = true;  // false: it is for the instance without following
};

// Reads a certificate of `instance` (checks its checksum and that the numbers exist) with at most
// `max_splits` splits, including those of lemmas. Checks strictly that the lines match the
// grammar, but not that they prove anything. Throws InputError.
CertificateText read_certificate(const std::filesystem::path& path, const Instance& instance,
                                 std::int64_t max_splits);

}  // namespace grove::detail
