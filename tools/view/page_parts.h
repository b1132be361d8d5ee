// SPDX-License-Identifier: MIT
// Style and script of each page. The build makes them from page/, run/, drive/ and proof/.
#pragma once

#include <string_view>

namespace grove::detail {

// Content of the <style> and <script> elements, without their end tags.
struct PageParts {
  std::string_view style;
  std::string_view program;
};

PageParts plan_page_parts();
PageParts run_page_parts();
PageParts drive_page_parts();
PageParts proof_page_parts();

}  // namespace grove::detail
