# shelfbeam_room([ROOMS <folder>...] [EXCEPT <source>...])
#
# Adds the sources beside the calling CMakeLists.txt to the library, but for those of EXCEPT, then the rooms below it.
function(shelfbeam_room)
  cmake_parse_arguments(PARSE_ARGV 0 room "" "" "ROOMS;EXCEPT")
  file(GLOB sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} *.cpp)
  list(REMOVE_ITEM sources ${room_EXCEPT} "")
  target_sources(shelfbeam_library PRIVATE ${sources})
  foreach(folder ${room_ROOMS})
    add_subdirectory(${folder})
  endforeach()
endfunction()
