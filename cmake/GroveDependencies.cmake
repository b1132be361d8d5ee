# SPDX-License-Identifier: MIT
# Finds dependencies of the build. All are Debian packages listed in tools/packages; nothing is downloaded. Dependencies
# of a single folder are found there: in tools, tools/view and tools/proof, and in tests and benchmarks
# (tools/packages.test, tools/packages.test-all). GrovePython.cmake finds those of the Python module.
find_package(fmt REQUIRED)
find_package(nlohmann_json 3.10 REQUIRED)
find_package(yaml-cpp 0.7 REQUIRED)
find_package(pugixml 1.12 REQUIRED)
# Some test programs have command lines, so tests need CLI11 too.
if(GROVE_BUILD_TOOLS OR GROVE_BUILD_TESTS)
  find_package(CLI11 REQUIRED)
endif()
find_package(Threads REQUIRED)
if(GROVE_WITH_MPI)
  include(GroveFindMpi)
  grove_find_mpi()
endif()
find_package(cereal 1.3 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)
if(GROVE_BUILD_TOOLS)
  pkg_check_modules(HTTPLIB REQUIRED IMPORTED_TARGET cpp-httplib)
endif()
if(GROVE_WITH_CADICAL)
  # Debian has only the static library, of position-independent code.
  find_path(CADICAL_INCLUDE_DIR cadical.hpp REQUIRED)
  find_library(CADICAL_LIBRARY cadical REQUIRED)
  add_library(cadical::cadical UNKNOWN IMPORTED)
  set_target_properties(cadical::cadical PROPERTIES
    IMPORTED_LOCATION ${CADICAL_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${CADICAL_INCLUDE_DIR})
endif()
if(GROVE_WITH_CBC)
  pkg_check_modules(CBC REQUIRED IMPORTED_TARGET cbc)
  # Programs link the static archives of CBC and its dependencies if they exist, because resolving the symbols of six
  # shared libraries takes about 40 % of the start-up time of a program. Shared libraries cannot link Debian's archives,
  # which are not position-independent.
  foreach(library IN LISTS CBC_LINK_LIBRARIES)
    string(REGEX REPLACE "/lib(Cbc|Cgl|Clp|CoinUtils|Osi)([A-Za-z]*)\\.so$" "/lib\\1\\2.a" archive ${library})
    if(EXISTS ${archive})
      set(library $<IF:$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>,${archive},${library}>)
    endif()
    list(APPEND cbc_libraries ${library})
  endforeach()
  set_target_properties(PkgConfig::CBC PROPERTIES INTERFACE_LINK_LIBRARIES "${cbc_libraries}")
endif()
