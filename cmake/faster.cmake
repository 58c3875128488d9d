# Programs that make repeated builds fast, used where they are installed. NO_CACHE, because they may be removed later.

# ccache keeps compiled units. They are found again in another checkout, because paths are relative to the checkout.
find_program(SHELFBEAM_CCACHE ccache NO_CACHE)
if(SHELFBEAM_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${SHELFBEAM_CCACHE})
endif()

# GCC supports mold from version 12.1.
find_program(SHELFBEAM_MOLD ld.mold NO_CACHE)
if(SHELFBEAM_MOLD AND (NOT CMAKE_CXX_COMPILER_ID STREQUAL GNU OR CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12.1))
  add_link_options(-fuse-ld=mold)
endif()
