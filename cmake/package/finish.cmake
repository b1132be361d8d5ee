# SPDX-License-Identifier: MIT
# cpack runs this script on the installed files before it makes packages. The script strips programs and libraries, adds
# the documents that Debian policy requires to each package, and renames folders as in Debian.
cmake_minimum_required(VERSION 3.22)
set(source ${CMAKE_CURRENT_LIST_DIR}/../..)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(version ${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
file(READ ${source}/LICENSE license)
string(REGEX MATCH "Copyright \\(c\\) ([^\n]*)\n\n(.*)" license "${license}")
set(copyright ${CMAKE_MATCH_1})
string(REPLACE "\n\n" "\n.\n" license "${CMAKE_MATCH_2}")
string(REGEX REPLACE "\n([^\n])" "\n \\1" license "${license}")

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(strip_files folder)
  file(GLOB_RECURSE files ${folder}/bin/* ${folder}/lib*/*)
  foreach(file IN LISTS files)
    if(IS_SYMLINK ${file})
      continue()
    endif()
    file(READ ${file} magic LIMIT 8 HEX)
    if(magic MATCHES "^7f454c46")
      run(strip --strip-unneeded --remove-section=.comment --remove-section=.note ${file})
    elseif(magic STREQUAL "213c617263683e0a")
      run(strip --strip-debug --enable-deterministic-archives --remove-section=.comment ${file})
    endif()
  endforeach()
endfunction()

function(write_documents folder)
  file(MAKE_DIRECTORY ${folder})
  file(REMOVE ${folder}/LICENSE ${folder}/CHANGES.md)
  file(WRITE ${folder}/copyright
    "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n"
    "Upstream-Name: Grove\n"
    "Comment: Programs hold parts of libraries of others, as Debian has them: of CBC,\n"
    " Cgl, Clp, CoinUtils and Osi (EPL-2.0), CLI11 (BSD-3-Clause), nlohmann-json\n"
    " (Expat), cereal (BSD-3-Clause) and pybind11 (BSD-3-Clause);\n"
    " grove-verify of Rust's standard library (Expat or Apache-2.0).\n\n"
    "Files: *\nCopyright: ${copyright}\nLicense: Expat\n\n"
    "Files: usr/libexec/grove/grove_vda5050/schemas/*\n"
    "Copyright: 2024 Verband der Automobilindustrie\nLicense: Expat\n\n"
    "License: Expat\n ${license}")
  configure_file(${source}/CHANGES.md ${folder}/changelog COPYONLY)
  file(WRITE ${folder}/changelog.Debian
    "grove (${version}) unstable; urgency=medium\n\n"
    "  * Packages made by cpack; what is new in Grove is in changelog.gz.\n\n"
    " -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  run(gzip -9nf ${folder}/changelog ${folder}/changelog.Debian)
endfunction()

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  set(usr ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr)
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  strip_files(${usr})
  if(EXISTS ${usr}/share/doc/grove AND NOT package STREQUAL grove)
    file(RENAME ${usr}/share/doc/grove ${usr}/share/doc/${package})
  endif()
  write_documents(${usr}/share/doc/${package})
  # The copyright file contains the text of this licence.
  file(REMOVE ${usr}/libexec/grove/grove_vda5050/schemas/LICENSE.txt
    ${usr}/libexec/grove/grove_vda5050/schemas/README.md)
  file(GLOB pages ${usr}/share/man/man1/*.1)
  if(pages)
    run(gzip -9nf ${pages})
  endif()
  if(EXISTS ${usr}/share/zsh/site-functions)
    file(RENAME ${usr}/share/zsh/site-functions ${usr}/share/zsh/vendor-completions)
  endif()
  file(MAKE_DIRECTORY ${usr}/share/lintian/overrides)
  configure_file(${source}/cmake/package/lintian-overrides ${usr}/share/lintian/overrides/${package} COPYONLY)
  if(component MATCHES "libraries")
    file(APPEND ${usr}/share/lintian/overrides/${package}
      "# Added by cpack, in addition to the trigger.\nmaintscript-calls-ldconfig\n")
  endif()
endforeach()
