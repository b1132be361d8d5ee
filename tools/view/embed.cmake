# SPDX-License-Identifier: MIT
# Writes OUTPUT, a C++ source that defines the function NAME_page_parts() of page_parts.h. The style is the
# concatenation of the files STYLES, with palette values in place of @...@. The program is the file PROGRAM.
include(${CMAKE_CURRENT_LIST_DIR}/palette.cmake)
foreach(file IN LISTS STYLES)
  file(READ ${file} text)
  string(APPEND style "${text}")
endforeach()
string(CONFIGURE "${style}" style @ONLY)
file(READ ${PROGRAM} program)
file(WRITE ${OUTPUT} "// Made by embed.cmake.
#include \"tools/view/page_parts.h\"

namespace grove::detail {

PageParts ${NAME}_page_parts() {
  return {R\"grove(${style})grove\", R\"grove(${program})grove\"};
}

}  // namespace grove::detail
")
