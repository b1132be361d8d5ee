# SPDX-License-Identifier: MIT
# FindMPI caches a failed search and then always fails. A search fails, for example, while the machine has no active
# network interface, because Open MPI's compiler wrapper then prints a message among its flags. Therefore
# grove_find_mpi() removes a failed search from the cache and quotes the message of the wrapper.

# grove_forget_cached(<prefix> <name> ...): removes all cache variables with the prefix, except those named <name>.
function(grove_forget_cached prefix)
  get_cmake_property(cached CACHE_VARIABLES)
  list(FILTER cached INCLUDE REGEX "^${prefix}")
  foreach(name IN LISTS cached)
    if(NOT name IN_LIST ARGN)
      unset(${name} CACHE)
    endif()
  endforeach()
endfunction()

# grove_find_mpi(): defines MPI::MPI_CXX or stops the configuration with an error. The next configuration searches
# again.
macro(grove_find_mpi)
  get_cmake_property(grove_given CACHE_VARIABLES)
  find_package(MPI 3.1 QUIET COMPONENTS CXX)
  if(NOT MPI_FOUND)
    set(grove_wrapper ${MPI_CXX_COMPILER})
    grove_forget_cached(MPI ${grove_given})
    grove_mpi_not_found("${grove_wrapper}")
  endif()
endmacro()

function(grove_mpi_not_found wrapper)
  if(NOT wrapper)
    set(why "no mpicxx was found; the package libopenmpi-dev has one")
  else()
    set(complaints "")
    foreach(flags -showme:compile -show)  # Open MPI; MPICH
      execute_process(COMMAND ${wrapper} ${flags} RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE complaints
        ERROR_STRIP_TRAILING_WHITESPACE)
      if(complaints STREQUAL "" OR status EQUAL 0)
        break()
      endif()
    endforeach()
    if(complaints STREQUAL "")
      set(why "a program compiled with the flags of ${wrapper} does not compile; see CMakeFiles/CMakeError.log")
    else()
      set(why "${wrapper} complains: ${complaints}")
      if(complaints MATCHES "network interface")
        string(APPEND why "\nBring up a network interface (ip link set lo up), and configure again.")
      endif()
    endif()
  endif()
  message(FATAL_ERROR "MPI 3.1 was not found: ${why}\n-D GROVE_WITH_MPI=OFF builds Grove without grove-mpi.")
endfunction()
