# SPDX-License-Identifier: MIT
# Build rules for commands that are Python programs.

# grove_python_copies(TARGET FILE...): copies files to the folder of the executable grove, where grove looks for them.
function(grove_python_copies target)
  foreach(file IN LISTS ARGN)
    add_custom_command(OUTPUT ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${file}
      COMMAND ${CMAKE_COMMAND} -E copy ${CMAKE_CURRENT_SOURCE_DIR}/${file}
              ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${file}
      DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file}
      COMMENT "Copying ${file}")
    list(APPEND copies ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${file})
  endforeach()
  add_custom_target(${target} ALL DEPENDS ${copies})
endfunction()

# grove_python_package(PACKAGE PATTERN...): copies the files of a package that match the patterns.
function(grove_python_package package)
  list(TRANSFORM ARGN PREPEND ${package}/ OUTPUT_VARIABLE patterns)
  file(GLOB sources RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS ${patterns})
  grove_python_copies(${package} ${sources})
endfunction()

# grove_python_program(PROGRAM PACKAGE PATTERN...): copies a program and its package.
function(grove_python_program program package)
  grove_python_package(${package} ${ARGN})
  grove_python_copies(${package}_program ${program})
  add_dependencies(${package} ${package}_program)
endfunction()
