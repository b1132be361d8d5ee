# SPDX-License-Identifier: MIT
# grove_python_program(PROGRAM PACKAGE PATTERN...): a command that is a Python program. It is run where
# grove looks for it: PROGRAM beside grove, of its package what matches the patterns beside that.
function(grove_python_program program package)
  list(TRANSFORM ARGN PREPEND ${package}/ OUTPUT_VARIABLE patterns)
  file(GLOB sources RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS ${patterns})
  foreach(file IN ITEMS ${program} LISTS sources)
    add_custom_command(OUTPUT ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${file}
      COMMAND ${CMAKE_COMMAND} -E copy ${CMAKE_CURRENT_SOURCE_DIR}/${file}
              ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${file}
      DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file}
      COMMENT "Copying ${file}")
    list(APPEND copies ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${file})
  endforeach()
  add_custom_target(${package} ALL DEPENDS ${copies})
endfunction()
