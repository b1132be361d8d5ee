# SPDX-License-Identifier: MIT
# Installation rules. The components are libraries, mpi_libraries, development, python, programs, pictures and
# mpi_programs. Each becomes a Debian package (GrovePackage.cmake).
include(CMakePackageConfigHelpers)

install(TARGETS grove_library EXPORT groveTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libraries NAMELINK_COMPONENT development)
if(GROVE_WITH_MPI)
  install(TARGETS grove_mpi_library EXPORT groveMpiTargets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT mpi_libraries NAMELINK_COMPONENT development)
else()
  set(grove_no_mpi PATTERN mpi.hpp EXCLUDE)
endif()
install(TARGETS grove_static EXPORT groveTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/grove/ ${PROJECT_BINARY_DIR}/include/grove/
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/grove COMPONENT development
  FILES_MATCHING PATTERN "*.hpp" ${grove_no_mpi})

# Files for find_package(grove) and pkg-config.
set(grove_package ${CMAKE_INSTALL_LIBDIR}/cmake/grove)
install(EXPORT groveTargets NAMESPACE grove:: DESTINATION ${grove_package} COMPONENT development)
if(GROVE_WITH_MPI)
  install(EXPORT groveMpiTargets NAMESPACE grove:: DESTINATION ${grove_package} COMPONENT development)
endif()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/groveConfig.cmake.in
  ${PROJECT_BINARY_DIR}/groveConfig.cmake INSTALL_DESTINATION ${grove_package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/groveConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/groveConfig.cmake ${PROJECT_BINARY_DIR}/groveConfigVersion.cmake
  DESTINATION ${grove_package} COMPONENT development)

list(TRANSFORM grove_needs PREPEND "-l" OUTPUT_VARIABLE grove_private)
string(JOIN " " grove_private ${grove_private})
file(RELATIVE_PATH grove_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(${CMAKE_CURRENT_LIST_DIR}/grove.pc.in ${PROJECT_BINARY_DIR}/grove.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/grove.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CHANGES.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT libraries)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/minimal ${PROJECT_SOURCE_DIR}/examples/lifelong
  DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples COMPONENT development
  FILES_MATCHING PATTERN "*.cpp" PATTERN "*.h")

if(GROVE_WITH_PYTHON)
  # The folder of modules depends on the installation prefix: a virtual environment has site-packages, Debian's Python
  # has dist-packages.
  set(grove_python python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR})
  if(Python_SITELIB MATCHES dist-packages)
    set(grove_outside dist-packages)
  else()
    set(grove_outside site-packages)
  endif()
  install(CODE "
    if(NOT \"${SKBUILD}\" STREQUAL \"\")  # a wheel (pyproject.toml)
      set(grove_packages .)
    elseif(EXISTS \"\${CMAKE_INSTALL_PREFIX}/pyvenv.cfg\")
      set(grove_packages lib/${grove_python}/site-packages)
    elseif(\"\${CMAKE_INSTALL_PREFIX}\" STREQUAL /usr AND ${grove_outside} STREQUAL dist-packages)
      set(grove_packages lib/python3/dist-packages)
    else()
      set(grove_packages lib/${grove_python}/${grove_outside})
    endif()" COMPONENT python)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/python/grove DESTINATION "\${grove_packages}" COMPONENT python
    PATTERN __pycache__ EXCLUDE)
  if(NOT SKBUILD)
    install(CODE "
      include(\"${CMAKE_CURRENT_LIST_DIR}/compile_python.cmake\")
      compile_python(\"${Python_EXECUTABLE}\" \"\${CMAKE_INSTALL_PREFIX}/\${grove_packages}/grove\")"
      COMPONENT python)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/python
      DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples COMPONENT python)
  endif()
endif()

if(NOT GROVE_BUILD_TOOLS)
  return()
endif()

install(TARGETS grove grove-sim RUNTIME COMPONENT programs)
if(GROVE_WITH_MPI)
  install(TARGETS grove-mpi RUNTIME COMPONENT mpi_programs)
  install(FILES ${PROJECT_SOURCE_DIR}/cluster/hostfile.example
    DESTINATION ${CMAKE_INSTALL_DATADIR}/grove/cluster COMPONENT mpi_programs)
  install(PROGRAMS ${PROJECT_SOURCE_DIR}/cluster/solve.sbatch ${PROJECT_SOURCE_DIR}/cluster/array.sbatch
    ${PROJECT_SOURCE_DIR}/cluster/preempt.sbatch
    DESTINATION ${CMAKE_INSTALL_DATADIR}/grove/cluster COMPONENT mpi_programs)
endif()
if(GROVE_WITH_VERIFY)
  install(PROGRAMS ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/grove-verify TYPE BIN COMPONENT programs)
  install(FILES ${PROJECT_SOURCE_DIR}/tools/proof/grove-verify.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT programs)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/tools/bench/solvers
  DESTINATION ${CMAKE_INSTALL_DATADIR}/grove COMPONENT programs)
install(PROGRAMS ${PROJECT_SOURCE_DIR}/tools/smoke-test
  DESTINATION ${CMAKE_INSTALL_DATADIR}/grove COMPONENT programs)
file(GLOB grove_pages ${PROJECT_SOURCE_DIR}/docs/*.md)
install(FILES ${grove_pages} DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/benchmarks/data/
  DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples COMPONENT programs
  FILES_MATCHING PATTERN "*.map" PATTERN "*.scen" PATTERN "*.json")
# Helper programs that grove executes, for instance for `grove report`, are installed in a separate folder, because
# users do not call them directly. The folder contains a link to grove for helper programs that call it.
set(grove_helper_programs ${CMAKE_INSTALL_LIBEXECDIR}/grove)
install(TARGETS grove-follow RUNTIME DESTINATION ${grove_helper_programs} COMPONENT programs)
install(TARGETS grove-picture RUNTIME DESTINATION ${grove_helper_programs} COMPONENT pictures)
foreach(program report toio vda5050)
  install(PROGRAMS ${PROJECT_SOURCE_DIR}/tools/${program}/grove-${program}
    DESTINATION ${grove_helper_programs} COMPONENT programs)
endforeach()
foreach(package driving report toio vda5050)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/tools/${package}/grove_${package}
    DESTINATION ${grove_helper_programs} COMPONENT programs PATTERN __pycache__ EXCLUDE)
endforeach()
install(CODE "
  include(\"${CMAKE_CURRENT_LIST_DIR}/compile_python.cmake\")
  foreach(package driving report toio vda5050)
    compile_python(/usr/bin/python3 \"\${CMAKE_INSTALL_PREFIX}/${grove_helper_programs}/grove_\${package}\")
  endforeach()" COMPONENT programs)
file(RELATIVE_PATH grove_from_helper_programs
  ${CMAKE_INSTALL_FULL_LIBEXECDIR}/grove ${CMAKE_INSTALL_FULL_BINDIR}/grove)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/helper_programs)
file(CREATE_LINK ${grove_from_helper_programs} ${PROJECT_BINARY_DIR}/helper_programs/grove SYMBOLIC)
install(FILES ${PROJECT_BINARY_DIR}/helper_programs/grove DESTINATION ${grove_helper_programs} COMPONENT programs)
# JSON schemas for editors; see docs/formats.md.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/schemas
  DESTINATION ${CMAKE_INSTALL_DATADIR}/grove COMPONENT programs)
