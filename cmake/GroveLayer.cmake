# SPDX-License-Identifier: MIT
# Assertions in debug and sanitizer builds and wherever audits are
# asked for. For all targets alike: headers hold some.
add_compile_definitions(
  $<$<OR:$<CONFIG:Debug>,$<BOOL:${GROVE_AUDIT}>>:GROVE_ASSERTIONS=1>
  $<$<BOOL:${GROVE_AUDIT}>:GROVE_AUDIT=1>)

add_library(grove_options INTERFACE)
target_compile_options(grove_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  $<$<BOOL:${GROVE_WERROR}>:-Werror>
  # GCC 12 sees overlapping copies in std::string's operator+ that are not there (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)

# So many sources of the target make one translation unit: for those whose headers take much longer
# to compile than they do. The compiler then takes no unit for what it is, a source, and warns of
# classes with members from unnamed namespaces.
function(grove_bundle target size)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${size})
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

# Of a target that is in no hurry, but whose headers take long to optimise.
function(grove_unhurried target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# What most sources include, compiled once, and the sources some at a time; but not in a Release
# build, which so tells when a source uses what it does not include.
add_library(grove_headers STATIC ${CMAKE_CURRENT_LIST_DIR}/precompiled.cpp)
target_link_libraries(grove_headers PRIVATE grove_options)
target_precompile_headers(grove_headers PRIVATE
  <algorithm> <array> <atomic> <chrono> <cstdint> <filesystem> <functional> <map> <memory> <mutex>
  <optional> <span> <string> <string_view> <vector>)
function(grove_precompile target)
  if(NOT CMAKE_BUILD_TYPE STREQUAL Release)
    target_precompile_headers(${target} REUSE_FROM grove_headers)
    grove_bundle(${target} 5)
  endif()
endfunction()

# grove_layer(<name> SOURCES ... [DEPENDS <layer> ...] [LINK_PUBLIC ...] [LINK_PRIVATE ...])
# One layer of the design as the static library grove_<name>, alias grove::<name>. Its interface is
# include/grove/<name>/, its text src/<name>/. `cmake --build --preset release --target grove_<name>`
# builds it alone.
function(grove_layer name)
  cmake_parse_arguments(LAYER "" "" "SOURCES;DEPENDS;LINK_PUBLIC;LINK_PRIVATE" ${ARGN})
  add_library(grove_${name} STATIC ${LAYER_SOURCES})
  add_library(grove::${name} ALIAS grove_${name})
  target_include_directories(grove_${name} PUBLIC ${PROJECT_SOURCE_DIR}/include)
  target_link_libraries(grove_${name} PRIVATE grove_options ${LAYER_LINK_PRIVATE})
  foreach(layer IN LISTS LAYER_DEPENDS)
    target_link_libraries(grove_${name} PUBLIC grove::${layer})
  endforeach()
  target_link_libraries(grove_${name} PUBLIC ${LAYER_LINK_PUBLIC})
  grove_precompile(grove_${name})
endfunction()
