// SPDX-License-Identifier: MIT
// Certificates that somebody has changed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace grove::detail::fuzz {

// Something of it is another: as one would change it who wants to have it say more, or by chance.
std::vector<std::string> mutated(std::vector<std::string> lines, std::uint64_t seed);

}  // namespace grove::detail::fuzz
