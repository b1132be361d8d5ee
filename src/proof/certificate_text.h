// SPDX-License-Identifier: MIT
// Certificates as they are read: docs/proof.md, section 3.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "model/instance.h"
#include "model/omega.h"

namespace grove::detail {

struct CertificateText {
  std::string lines;       // all of them, uncompressed, ended by LF
  Cost bound = 0;          // of the theorem; kInfiniteCost: there is no plan
  bool may_follow = true;  // false: it speaks of the instance without following
};

// Of this instance, by its checksum and the numbers that occur; with at most so many splits, those
// of lemmas included. That its lines are as the grammar has them is checked, strictly; not that
// they prove anything. Throws InputError.
CertificateText read_certificate(const std::filesystem::path& path, const Instance& instance,
                                 std::int64_t most_splits);

}  // namespace grove::detail
