# SPDX-License-Identifier: MIT
# compile_python(INTERPRETER FOLDER), of `cmake --install`: compiles what is installed, as Python itself
# would at the first run, and puts it into the manifest: so whoever uninstalls by that leaves nothing.
# Packages are compiled where they are unpacked.
function(compile_python interpreter folder)
  if(NOT "$ENV{DESTDIR}" STREQUAL "" OR NOT EXISTS "${interpreter}")
    return()
  endif()
  execute_process(COMMAND "${interpreter}" -m compileall -q "${folder}")
  file(GLOB_RECURSE compiled "${folder}/*.pyc")
  set(CMAKE_INSTALL_MANIFEST_FILES "${CMAKE_INSTALL_MANIFEST_FILES};${compiled}" PARENT_SCOPE)
endfunction()
