# SPDX-License-Identifier: MIT
# Writes OUTPUT, which defines what page_parts.h declares of the page NAME: the texts of the files
# STYLE and PROGRAM.
file(READ ${STYLE} style)
file(READ ${PROGRAM} program)
file(WRITE ${OUTPUT} "// Made by embed.cmake.
#include \"tools/view/page_parts.h\"

namespace grove {

PageParts ${NAME}_page_parts() {
  return {R\"grove(${style})grove\", R\"grove(${program})grove\"};
}

}  // namespace grove
")
