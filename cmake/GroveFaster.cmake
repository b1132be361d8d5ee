# SPDX-License-Identifier: MIT
# What makes building faster where it is installed, and is not needed.

# A compiler's results are kept from build to build. (With precompiled headers ccache needs to be told
# that time stamps in them do not matter; it then asks the compiler what a source includes.)
find_program(GROVE_CCACHE ccache)
if(GROVE_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
    env CCACHE_DEPEND=1 CCACHE_SLOPPINESS=pch_defines,time_macros ${GROVE_CCACHE})
endif()

# A faster linker.
include(CheckLinkerFlag)
foreach(linker mold lld)
  check_linker_flag(CXX -fuse-ld=${linker} GROVE_LINKS_WITH_${linker})
  if(GROVE_LINKS_WITH_${linker})
    add_link_options(-fuse-ld=${linker})
    break()
  endif()
endforeach()

# GCC collects its garbage less often: that takes time, and memory is there.
add_compile_options($<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1048576>)
