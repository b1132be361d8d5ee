// SPDX-License-Identifier: MIT
// Reads a whole certificate as text, for display (format: docs/proof.md, section 3).
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
  bool may_follow = true;  // false: the theorem is about plans without following
};

// Reads a certificate of `instance` with at most `max_splits` splits, including those in lemmas,
// and at most 16 MiB of uncompressed text. Checks it as read_certificate_lines() does, which does
// not verify that the certificate proves anything. Throws InputError.
CertificateText read_certificate(const std::filesystem::path& path, const Instance& instance,
                                 std::int64_t max_splits);

}  // namespace grove::detail
