# SPDX-License-Identifier: MIT
# cmake -DSOURCE_DIR=... -DOUTPUT=... -P git_hash.cmake
# Writes a header that defines GROVE_GIT_HASH as the abbreviated commit hash, with "-dirty" appended if tracked files
# have changed; "unknown" outside a git clone.
cmake_minimum_required(VERSION 3.22)
execute_process(
  COMMAND git -c safe.directory=* describe --always --dirty --abbrev=12 --exclude=*
  WORKING_DIRECTORY ${SOURCE_DIR}
  OUTPUT_VARIABLE hash OUTPUT_STRIP_TRAILING_WHITESPACE
  RESULT_VARIABLE failure ERROR_QUIET)
if(failure)
  set(hash "unknown")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define GROVE_GIT_HASH \"@hash@\"\n" @ONLY)
