# SPDX-License-Identifier: MIT
# Writes OUTPUT, which defines what page_parts.h declares of the page NAME: the texts of the files
# STYLES, one after the other, and of PROGRAM.
foreach(file IN LISTS STYLES)
  file(READ ${file} text)
  string(APPEND style "${text}")
endforeach()
file(READ ${PROGRAM} program)
file(WRITE ${OUTPUT} "// Made by embed.cmake.
#include \"tools/view/page_parts.h\"

namespace grove::detail {

PageParts ${NAME}_page_parts() {
  return {R\"grove(${style})grove\", R\"grove(${program})grove\"};
}

}  // namespace grove::detail
")
