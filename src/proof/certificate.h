// SPDX-License-Identifier: MIT
// Certificates of lower bounds (docs/proof.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "model/instance.h"
#include "model/omega.h"

namespace grove::detail {

// Of a certificate that was written.
struct Certificate {
  Cost bound = 0;  // what it proves; kInfiniteCost: there is no plan
  std::int64_t splits = 0;
  std::int64_t leaves = 0;
  std::int64_t lemmas = 0;
  std::int64_t bytes = 0;
  bool by_joint_search = false;  // nothing but `joint`: a checker does all the search again
};

// Makes a certificate of what was written down in these files (proof_parts.h), for a bound of
// `claimed` or, where they do not have the reasons for that, of as much as they have; and of no
// more than it takes: of the tree and of the lemmas what that bound needs. Written whole or not at
// all, compressed. Throws InputError. Holds about a hundred bytes for each split and each bound
// that was written down.
Certificate write_certificate(const Instance& instance,
                              std::span<const std::filesystem::path> parts, Cost claimed,
                              const std::filesystem::path& file);

// The checksum by which a certificate names its instance (docs/proof.md, section 6).
std::uint64_t certificate_checksum(const Instance& instance);

}  // namespace grove::detail
