# SPDX-License-Identifier: MIT
# Writes OUTPUT, which defines what page_parts.h declares: the texts of the files STYLE and PROGRAM.
file(READ ${STYLE} style)
file(READ ${PROGRAM} program)
file(WRITE ${OUTPUT} "// Made by embed.cmake.
#include \"tools/view/page_parts.h\"

namespace grove {

std::string_view page_style() {
  return R\"grove(${style})grove\";
}

std::string_view page_program() {
  return R\"grove(${program})grove\";
}

}  // namespace grove
")
