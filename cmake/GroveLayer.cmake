# SPDX-License-Identifier: MIT
# Enables assertions, also in the standard library, in debug and sanitizer builds. All targets use the same setting,
# because headers contain assertions.
add_compile_definitions("$<$<CONFIG:Debug>:GROVE_ASSERTIONS=1;_GLIBCXX_ASSERTIONS>")

# Compiler options and the text output library (fmt) for all targets.
add_library(grove_options INTERFACE)
target_link_libraries(grove_options INTERFACE fmt::fmt)
target_compile_options(grove_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  $<$<BOOL:${GROVE_WERROR}>:-Werror>
  # GCC 12 reports overlapping copies in std::string's operator+, a false positive (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # Clang 17 and later warn about a deprecated function that std::stable_sort calls in the library of GCC 12.
  $<$<AND:$<CXX_COMPILER_ID:Clang>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,17>>:-Wno-error=deprecated-declarations>
  # GCC does not recognise unity builds and warns about classes with members from unnamed namespaces.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wno-subobject-linkage>)

# Precompiled headers for most sources, because parsing headers takes longer than compiling the sources. If hot code is
# compiled with additional flags, it has its own precompiled header.
set(GROVE_HOT_FLAGS "" CACHE STRING "Additional compiler flags for hot code")
function(grove_headers name)
  add_library(${name} STATIC ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
  target_link_libraries(${name} PRIVATE grove_options)
  target_compile_options(${name} PRIVATE ${ARGN})
  target_precompile_headers(${name} PRIVATE
    <algorithm> <array> <atomic> <chrono> <cstdint> <filesystem> <functional> <map> <memory> <mutex>
    <optional> <set> <span> <string> <string_view> <vector> <fmt/format.h>)
endfunction()
grove_headers(grove_headers)
if(GROVE_HOT_FLAGS)
  grove_headers(grove_hot_headers ${GROVE_HOT_FLAGS})
else()
  add_library(grove_hot_headers ALIAS grove_headers)
endif()

# grove_compile(<target> [HOT | COLD])
# Sets the compiler options of a target. HOT is for code that takes most of the run time. COLD is for code that
# takes hardly any run time and whose headers take long to optimise: it is compiled with -O1 in release builds and, in
# unity builds, as one source.
function(grove_compile target)
  cmake_parse_arguments(COMPILE "HOT;COLD" "" "" ${ARGN})
  target_link_libraries(${target} PRIVATE grove_options)
  if(COMPILE_HOT)
    target_compile_options(${target} PRIVATE ${GROVE_HOT_FLAGS})
    target_precompile_headers(${target} REUSE_FROM grove_hot_headers)
  else()
    target_compile_options(${target} PRIVATE $<$<AND:$<BOOL:${COMPILE_COLD}>,$<CONFIG:Release>>:-O1>)
    target_precompile_headers(${target} REUSE_FROM grove_headers)
    if(COMPILE_COLD)
      set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE 0)
    endif()
  endif()
endfunction()

# grove_layer(<name> [HOT | COLD] [DEPENDS <layer> ...] [LINK_PUBLIC ...] [LINK_PRIVATE ...])
# Defines one layer of the design as the static library grove_<name>, alias grove::<name>, from the headers and
# sources in src/<name>/ and its directory components/, if any. `cmake --build --preset release --target grove_<name>` builds only this layer.
function(grove_layer name)
  cmake_parse_arguments(LAYER "" "" "DEPENDS;LINK_PUBLIC;LINK_PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp components/*.cpp)
  add_library(grove_${name} STATIC ${sources})
  add_library(grove::${name} ALIAS grove_${name})
  target_include_directories(grove_${name} PUBLIC ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
  list(TRANSFORM LAYER_DEPENDS PREPEND grove::)
  target_link_libraries(grove_${name} PUBLIC ${LAYER_DEPENDS} ${LAYER_LINK_PUBLIC} PRIVATE ${LAYER_LINK_PRIVATE})
  grove_compile(grove_${name} ${LAYER_UNPARSED_ARGUMENTS})
endfunction()

# grove_private_headers(<name> <header> ...)
# Declares the headers of grove_<name> that no other layer includes. tests/structure compares the list with the sources.
function(grove_private_headers name)
  target_sources(grove_${name} PRIVATE ${ARGN})
endfunction()
