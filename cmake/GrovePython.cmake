# SPDX-License-Identifier: MIT
# Selects the Python interpreter for the module: Debian's, for which useful packages exist, unless Python_EXECUTABLE
# names a different one.
if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
set(PYBIND11_FINDPYTHON ON)
if(GROVE_BUILD_TOOLS)
  find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
  if(Python_FOUND)
    find_package(pybind11 2.9 QUIET)
  endif()
endif()
# The module depends on the programs, because it uses their code for HTML pages.
include(CMakeDependentOption)
cmake_dependent_option(GROVE_WITH_PYTHON "Build the Python module" "${pybind11_FOUND}" GROVE_BUILD_TOOLS OFF)
if(GROVE_WITH_PYTHON)
  find_package(Python 3.9 REQUIRED COMPONENTS Interpreter Development.Module)
  find_package(pybind11 2.9 REQUIRED)
endif()
