// SPDX-License-Identifier: MIT
// Style and script of the pages, made by the build from page/, run/, drive/ and proof/.
#pragma once

#include <string_view>

namespace grove::detail {

// Neither contains the end tag of its element.
struct PageParts {
  std::string_view style;
  std::string_view program;
};

PageParts plan_page_parts();
PageParts run_page_parts();
PageParts drive_page_parts();
PageParts proof_page_parts();

}  // namespace grove::detail
