# SPDX-License-Identifier: MIT
# compile_python(INTERPRETER FOLDER): compiles installed Python files during `cmake --install`, as Python would at the
# first run, and adds the results to the install manifest, so that uninstalling by the manifest leaves no files behind.
# Does nothing without the interpreter, or with DESTDIR: Debian packages compile the files when they are installed.
function(compile_python interpreter folder)
  if(NOT "$ENV{DESTDIR}" STREQUAL "" OR NOT EXISTS "${interpreter}")
    return()
  endif()
  execute_process(COMMAND "${interpreter}" -m compileall -q "${folder}")
  file(GLOB_RECURSE compiled "${folder}/*.pyc")
  set(CMAKE_INSTALL_MANIFEST_FILES "${CMAKE_INSTALL_MANIFEST_FILES};${compiled}" PARENT_SCOPE)
endfunction()
