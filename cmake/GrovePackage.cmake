# SPDX-License-Identifier: MIT
# Debian packages, which `cpack` makes, one per installed component. The folders of libraries and Python modules depend
# on the prefix, so packages need a build with prefix /usr (tools/package).
if(NOT PROJECT_IS_TOP_LEVEL OR NOT GROVE_BUILD_TOOLS OR NOT CMAKE_INSTALL_PREFIX STREQUAL /usr)
  return()
endif()

set(GROVE_MAINTAINER "The Grove authors <grove@localhost>" CACHE STRING
  "Who answers for the packages: Name <address>")
set(CPACK_PACKAGE_CONTACT ${GROVE_MAINTAINER})
set(CPACK_GENERATOR DEB)
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_PACKAGE_RELEASE 0grove1)  # lower than any revision of a package by Debian
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_PACKAGE_SOURCE grove)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own summary
set(grove_debian ${PROJECT_SOURCE_DIR}/cmake/package)
# Does what Debian policy requires: strips programs, adds copyright and changelogs, compresses manual pages.
set(CPACK_PRE_BUILD_SCRIPTS ${grove_debian}/finish.cmake)

# grove_package(COMPONENT NAME SECTION SUMMARY TEXT [FIELD VALUE]...)
macro(grove_package component name section summary text)
  string(TOUPPER ${component} upper)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${text}")
  cmake_parse_arguments(field "" "DEPENDS;RECOMMENDS;SUGGESTS" "" ${ARGN})
  foreach(field DEPENDS RECOMMENDS SUGGESTS)
    if(field_${field})
      set(CPACK_DEBIAN_${upper}_PACKAGE_${field} ${field_${field}})
    endif()
  endforeach()
endmacro()

set(grove_what "Many robots on a grid or a roadmap, each with places to visit in any order;
none may collide. Grove finds a plan for all of them, and proves how far from
the best it is.

This package holds ")
set(grove_abi ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(grove_same "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")

set(CPACK_COMPONENTS_ALL "")
# Depends on python3, because three commands are Python programs. Other packages are only suggested, because few users
# need them and they would install MPI, X11 or a hundred packages. A command names a missing package that it needs.
grove_package(programs grove science
  "solver for multi-agent path finding with tasks and proven bounds"
  "${grove_what}the programs: grove; grove-sim, which predicts the
scaling to many processes; and grove-verify, which checks certificates. The
package grove-mpi has the program for many processes and machines,
grove-pictures the program that draws plans as SVG, PNG and GIF."
  DEPENDS python3
  SUGGESTS "grove-pictures, grove-mpi, python3-matplotlib, python3-bleak, python3-paho-mqtt, python3-grove")
grove_package(pictures grove-pictures science
  "solver for multi-agent path finding with tasks - pictures of plans"
  "${grove_what}the program that draws plans as SVG, PNG and GIF for
grove view."
  DEPENDS "grove ${grove_same}")
if(GROVE_WITH_MPI)
  grove_package(mpi_programs grove-mpi science
    "solver for multi-agent path finding with tasks - many machines"
    "${grove_what}grove-mpi, which solves on many processes and
machines, and scripts for Slurm."
    DEPENDS "grove ${grove_same}" RECOMMENDS openmpi-bin)
endif()
grove_package(libraries libgrove${grove_abi} libs
  "solver for multi-agent path finding with tasks - shared library"
  "${grove_what}the library for programs in C++.")
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_CONTROL_EXTRA ${grove_debian}/triggers)
set(grove_needs_libraries "libgrove${grove_abi} ${grove_same}")
set(grove_may_need "libfmt-dev, zlib1g-dev, libyaml-cpp-dev, libpugixml-dev")
if(GROVE_WITH_CADICAL)
  string(APPEND grove_may_need ", libcadical-dev")
endif()
if(GROVE_WITH_CBC)
  string(APPEND grove_may_need ", coinor-libcbc-dev")
endif()
if(GROVE_WITH_MPI)
  # A separate package, because it depends on an MPI implementation.
  grove_package(mpi_libraries libgrove-mpi${grove_abi} libs
    "solver for multi-agent path finding with tasks - shared MPI library"
    "${grove_what}the library for programs in C++ of many processes.")
  set(CPACK_DEBIAN_MPI_LIBRARIES_PACKAGE_CONTROL_EXTRA ${grove_debian}/triggers)
  string(APPEND grove_needs_libraries ", libgrove-mpi${grove_abi} ${grove_same}")
  string(APPEND grove_may_need ", libopenmpi-dev")
endif()
# Does not depend on the libraries that the static library needs, nor on an MPI for the component mpi, because few users
# need them.
grove_package(development libgrove-dev libdevel
  "solver for multi-agent path finding with tasks - development files"
  "${grove_what}headers, the static library, and the files for CMake
and pkg-config."
  DEPENDS ${grove_needs_libraries} SUGGESTS ${grove_may_need})
if(GROVE_WITH_PYTHON)
  math(EXPR grove_next_python "${Python_VERSION_MINOR} + 1")
  grove_package(python python3-grove python
    "solver for multi-agent path finding with tasks - Python module"
    "${grove_what}the module for Python 3."
    DEPENDS "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}~), python3 (<< ${Python_VERSION_MAJOR}.${grove_next_python}~)"
    RECOMMENDS python3-numpy SUGGESTS python3-pandas)
endif()

# Scripts that make and remove the bytecode of Python programs when a package is installed and removed.
foreach(component programs python)
  string(TOUPPER ${component} upper)
  set(GROVE_PACKAGE ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(GROVE_FOLDERS "")
  if(component STREQUAL programs)
    set(GROVE_FOLDERS " /usr/libexec/grove")
  endif()
  foreach(script postinst prerm)
    configure_file(${grove_debian}/${script}.in ${PROJECT_BINARY_DIR}/package/${component}/${script} @ONLY)
    list(APPEND CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/package/${component}/${script})
  endforeach()
endforeach()
include(CPack)
