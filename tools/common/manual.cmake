# SPDX-License-Identifier: MIT
# grove_manual(PROGRAM COMPONENT): lets the program write its manual pages and shell completions to
# build/<preset>/manual, and installs them with the component.
function(grove_manual program component)
  set(folder ${PROJECT_BINARY_DIR}/manual)
  set(pages ${folder}/man1/${program})
  add_custom_command(OUTPUT ${folder}/${program}.bash ${folder}/_${program} ${folder}/${program}.fish ${pages}
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${pages}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${pages}
    COMMAND ${program} help --manual ${pages}
    COMMAND ${program} help --completion bash > ${folder}/${program}.bash
    COMMAND ${program} help --completion zsh > ${folder}/_${program}
    COMMAND ${program} help --completion fish > ${folder}/${program}.fish
    DEPENDS ${program} COMMENT "Writing the manual of ${program}" VERBATIM)
  add_custom_target(${program}-manual ALL DEPENDS ${folder}/${program}.bash)
  if(NOT GROVE_INSTALL)
    return()
  endif()
  install(DIRECTORY ${pages}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${component})
  install(FILES ${folder}/${program}.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
    RENAME ${program} COMPONENT ${component})
  install(FILES ${folder}/_${program} DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT ${component})
  install(FILES ${folder}/${program}.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
    COMPONENT ${component})
endfunction()
