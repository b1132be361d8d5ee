// SPDX-License-Identifier: MIT
// Style and program of the pages, as the build makes them of page/, run/, drive/ and proof/.
#pragma once

#include <string_view>

namespace grove::detail {

// Neither holds an end of its element.
struct PageParts {
  std::string_view style;
  std::string_view program;
};

PageParts plan_page_parts();
PageParts run_page_parts();
PageParts drive_page_parts();
PageParts proof_page_parts();

}  // namespace grove::detail
