// SPDX-License-Identifier: MIT
// Mutations of certificates, to test that the checker refuses false ones.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace grove::detail::fuzz {

// Returns `lines` with one to four random mutations: a number or keyword is changed, a line is
// removed, duplicated or swapped, or a subtree is replaced by a leaf. Often the theorem is also
// changed to claim a higher bound, as in a forged certificate.
std::vector<std::string> mutated(std::vector<std::string> lines, std::uint64_t seed);

}  // namespace grove::detail::fuzz
