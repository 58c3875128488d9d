# cmake -DWANTED=... -P cannot_run.cmake: in the place of a test of the 3-D view where the build has none. Skipped, and an
# error where continuous integration (CI is set) wanted one.
set(why "this build has no 3-D view: Node.js or its packages are missing, see the configuration")
if(WANTED AND DEFINED ENV{CI})
  message(FATAL_ERROR "${why}")
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -E echo "skipped: ${why}")
