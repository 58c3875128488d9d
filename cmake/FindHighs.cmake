# Finds the HiGHS solver: target Highs::Highs, variables Highs_FOUND and Highs_VERSION.
#
# The package configuration of Debian 13's libhighs-dev 1.10 names files of its build machine, so every
# find_package(highs CONFIG) fails. Searching for the header and the library works everywhere.

# The build of scripts/build-highs is searched last.
execute_process(COMMAND ${CMAKE_CURRENT_LIST_DIR}/../scripts/build-highs --prefix
                OUTPUT_VARIABLE highs_prefix OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
find_path(HIGHS_INCLUDE_DIR Highs.h PATHS ${highs_prefix}/include PATH_SUFFIXES highs)
find_library(HIGHS_LIBRARY highs PATHS ${highs_prefix}/lib)

if(HIGHS_INCLUDE_DIR)
  file(STRINGS ${HIGHS_INCLUDE_DIR}/HConfig.h highs_numbers REGEX "HIGHS_VERSION_(MAJOR|MINOR|PATCH) ")
  string(REGEX REPLACE "[^;0-9]" "" highs_numbers "${highs_numbers}")
  string(REPLACE ";" "." Highs_VERSION "${highs_numbers}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Highs REQUIRED_VARS HIGHS_LIBRARY HIGHS_INCLUDE_DIR VERSION_VAR Highs_VERSION)
mark_as_advanced(HIGHS_INCLUDE_DIR HIGHS_LIBRARY)

if(Highs_FOUND AND NOT TARGET Highs::Highs)
  find_package(Threads REQUIRED)
  add_library(Highs::Highs UNKNOWN IMPORTED)
  set_target_properties(Highs::Highs PROPERTIES
    IMPORTED_LOCATION ${HIGHS_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${HIGHS_INCLUDE_DIR}
    INTERFACE_LINK_LIBRARIES Threads::Threads)
endif()
