# SPDX-License-Identifier: MIT
# Optional tools and flags that make builds faster.

# ccache keeps compiler results between builds. With precompiled headers it must ignore macros such as __TIME__ and
# changed #defines. It gets the list of included files from the compiler (depend mode).
find_program(GROVE_CCACHE ccache)
if(GROVE_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
    env CCACHE_DEPEND=1 CCACHE_SLOPPINESS=pch_defines,time_macros ${GROVE_CCACHE})
endif()

# Uses the first available of the faster linkers.
include(CheckLinkerFlag)
foreach(linker mold lld)
  check_linker_flag(CXX -fuse-ld=${linker} GROVE_LINKS_WITH_${linker})
  if(GROVE_LINKS_WITH_${linker})
    add_link_options(-fuse-ld=${linker})
    break()
  endif()
endforeach()

# Makes GCC collect garbage less often. This is faster but uses more memory.
add_compile_options($<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1048576>)
