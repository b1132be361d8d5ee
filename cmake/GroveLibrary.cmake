# SPDX-License-Identifier: MIT
# The installed library, which contains the public API and the layers that it needs in one file, shared or static.
set(grove_library_layers model execution io sequencing assignment planning joint lagrangian conflicts search primal baselines engine api)
if(GROVE_WITH_CADICAL)
  list(APPEND grove_library_layers cores)
endif()
list(TRANSFORM grove_library_layers PREPEND grove_)

# Sets properties of all library targets. Before version 1.0 a minor version may break the ABI, so the SONAME contains
# the minor version.
function(grove_library target name)
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name} LINKER_LANGUAGE CXX
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_compile_features(${target} INTERFACE cxx_std_20)
  target_include_directories(${target} INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
    $<INSTALL_INTERFACE:include>)
endfunction()

add_library(grove_library SHARED $<TARGET_OBJECTS:grove_api>)
add_library(grove::grove ALIAS grove_library)
grove_library(grove_library grove)
target_link_libraries(grove_library PRIVATE grove_api)
# Hides the symbols of static libraries: the layers and their dependencies.
target_link_options(grove_library PRIVATE -Wl,--exclude-libs,ALL)
set_target_properties(grove_library PROPERTIES EXPORT_NAME grove)

# A second shared library with the same content and grove::mpi::solve(). A program links only one of the two.
if(GROVE_WITH_MPI)
  add_library(grove_mpi_library SHARED $<TARGET_OBJECTS:grove_api> ${PROJECT_SOURCE_DIR}/mpi/public_api.cpp)
  add_library(grove::mpi ALIAS grove_mpi_library)
  grove_library(grove_mpi_library grove-mpi)
  target_include_directories(grove_mpi_library PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(grove_mpi_library PUBLIC MPI::MPI_CXX PRIVATE grove_options grove_api grove_mpi)
  target_link_options(grove_mpi_library PRIVATE -Wl,--exclude-libs,ALL)
  set_target_properties(grove_mpi_library PROPERTIES EXPORT_NAME mpi)
endif()

set(objects ${grove_library_layers})
list(TRANSFORM objects REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>")
add_library(grove_static STATIC ${objects})
add_library(grove::grove_static ALIAS grove_static)
grove_library(grove_static grove)
# Programs link the dependencies of the static library by name, because they are in the linker's search path.
set(grove_needs fmt z yaml-cpp pugixml pthread)
if(GROVE_WITH_CADICAL)
  list(APPEND grove_needs cadical)
endif()
if(GROVE_WITH_CBC)
  list(APPEND grove_needs Cbc Cgl OsiClp ClpSolver Clp Osi CoinUtils)
endif()
target_link_libraries(grove_static INTERFACE ${grove_needs})
