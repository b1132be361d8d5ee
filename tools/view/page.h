// SPDX-License-Identifier: MIT
// The page of `grove view`: one file that needs nothing beside it.
#pragma once

#include <string>
#include <string_view>

namespace grove {

// `data`: of page_data.h.
std::string page(std::string_view title, std::string_view data);

}  // namespace grove
