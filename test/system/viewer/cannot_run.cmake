# cmake -DWANTED=... -DPART=... -P cannot_run.cmake: replaces a test of the pages or of the Python module if the build
# has none. Counts as skipped, or as an error if continuous integration (CI is set) requires them.
set(why "this build has no ${PART}: packages are missing, see the configuration")
if(WANTED AND DEFINED ENV{CI})
  message(FATAL_ERROR "${why}")
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -E echo "skipped: ${why}")
