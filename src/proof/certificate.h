// SPDX-License-Identifier: MIT
// Certificates of lower bounds (docs/proof.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "model/instance.h"
#include "model/omega.h"

namespace grove::detail {

// Statistics of a written certificate.
struct Certificate {
  Cost bound = 0;           // the proven lower bound; kInfiniteCost: there is no plan
  std::int64_t splits = 0;  // in the proof of the theorem, not in lemmas
  std::int64_t leaves = 0;  // as `splits`
  std::int64_t lemmas = 0;
  std::int64_t bytes = 0;
  bool by_joint_search = false;  // the proof is only `joint`: a checker searches all joint paths
};

// Writes to `file` a certificate made from the proof logs `parts` (proof_parts.h). The certificate
// proves the bound `claimed` or, if the logs do not suffice, the greatest bound that they prove. It
// contains only those parts of the trees and those lemmas that this bound needs. The compressed
// file appears completely or not at all, except that special files are written directly
// (AtomicFile). If the instance has choices, only formulas of the logs are used. Throws InputError.
// Takes about 100 bytes of memory for each logged split and bound.
Certificate write_certificate(const Instance& instance,
                              std::span<const std::filesystem::path> parts, Cost claimed,
                              const std::filesystem::path& file);

// Returns the checksum that identifies the instance in a certificate (docs/proof.md, section 6).
std::uint64_t certificate_checksum(const Instance& instance);

}  // namespace grove::detail
