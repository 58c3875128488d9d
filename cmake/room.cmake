# shelfbeam_room([ROOMS <folder>...] [PUBLIC <header>...] [EXCEPT <source>...])
#
# Adds the sources beside the calling CMakeLists.txt to the library, except those of EXCEPT, and then the subfolders
# ROOMS. PUBLIC headers are installed; they include only public headers.
function(shelfbeam_room)
  cmake_parse_arguments(PARSE_ARGV 0 room "" "" "ROOMS;PUBLIC;EXCEPT")
  file(GLOB sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} *.cpp)
  list(REMOVE_ITEM sources ${room_EXCEPT} "")
  target_sources(shelfbeam_library PRIVATE ${sources})
  if(room_PUBLIC)
    target_sources(shelfbeam_library PUBLIC
      FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src FILES ${room_PUBLIC})
  endif()
  foreach(folder ${room_ROOMS})
    add_subdirectory(${folder})
  endforeach()
endfunction()
