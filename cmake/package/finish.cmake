# SPDX-License-Identifier: MIT
# Run by cpack on what is installed, before it becomes packages: each gets the documents that Debian
# wants in it, and the folders are Debian's.
cmake_minimum_required(VERSION 3.22)
set(source ${CMAKE_CURRENT_LIST_DIR}/../..)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(version ${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
file(READ ${source}/LICENSE license)
string(REGEX MATCH "Copyright[^\n]*" copyright "${license}")
string(REGEX REPLACE ".*Copyright[^\n]*\n\n" "" license "${license}")
string(REGEX REPLACE "\n\n" "\n.\n" license "${license}")
string(REGEX REPLACE "\n([^\n])" "\n \\1" license "${license}")

function(compress file)
  execute_process(COMMAND gzip -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  set(usr ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr)
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(documents ${usr}/share/doc/${package})
  if(EXISTS ${usr}/share/doc/grove AND NOT package STREQUAL grove)
    file(RENAME ${usr}/share/doc/grove ${documents})
  endif()
  file(REMOVE ${documents}/LICENSE ${documents}/CHANGES.md)
  file(WRITE ${documents}/copyright
    "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n"
    "Upstream-Name: Grove\n\n"
    "Files: *\n${copyright}\nLicense: Expat\n ${license}")
  file(COPY ${source}/CHANGES.md DESTINATION ${documents})
  file(RENAME ${documents}/CHANGES.md ${documents}/changelog)
  file(WRITE ${documents}/changelog.Debian
    "grove (${version}) unstable; urgency=medium\n\n"
    "  * Packages made by cpack; what is new in Grove is in changelog.gz.\n\n"
    " -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  compress(${documents}/changelog)
  compress(${documents}/changelog.Debian)
  file(GLOB pages ${usr}/share/man/man1/*.1)
  foreach(page IN LISTS pages)
    compress(${page})
  endforeach()
  if(EXISTS ${usr}/share/zsh/site-functions)
    file(RENAME ${usr}/share/zsh/site-functions ${usr}/share/zsh/vendor-completions)
  endif()
  if(EXISTS ${source}/cmake/package/${component}.lintian-overrides)
    file(MAKE_DIRECTORY ${usr}/share/lintian/overrides)
    configure_file(${source}/cmake/package/${component}.lintian-overrides
      ${usr}/share/lintian/overrides/${package} COPYONLY)
  endif()
endforeach()
