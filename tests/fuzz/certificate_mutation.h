// SPDX-License-Identifier: MIT
// Mutations of certificates, to test that the checker refuses false ones.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace grove::detail::fuzz {

// Returns `lines` (not empty) after one to four random mutations, some of which may have no effect.
// A mutation changes a number or keyword, removes a line, inserts a copy of a line, swaps two lines
// or replaces a subtree by a leaf. Often the theorem is also changed to claim a higher bound, as in
// a forged certificate.
std::vector<std::string> mutated(std::vector<std::string> lines, std::uint64_t seed);

}  // namespace grove::detail::fuzz
