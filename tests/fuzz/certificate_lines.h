// SPDX-License-Identifier: MIT
// What is in the file of a certificate.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace grove::detail::fuzz {

// Of one that is compressed; without their ends. Throws where it is not as it should be.
std::vector<std::string> certificate_lines(const std::filesystem::path& file);

}  // namespace grove::detail::fuzz
