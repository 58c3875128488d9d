# shelfbeam_layer(<folder> [IDLE] [NEEDS <layer>...] [PUBLIC <header>...] [EXCEPT <source>...])
#
# Makes the static library shelfbeam_<folder> of all sources below a folder, except those of EXCEPT, and links it to the
# layers that it needs. PUBLIC headers are installed; they include only public headers. No time is spent in IDLE layers:
# -O1 cuts a quarter of their compile time.
function(shelfbeam_layer folder)
  cmake_parse_arguments(PARSE_ARGV 1 layer "IDLE" "" "NEEDS;PUBLIC;EXCEPT")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} ${folder}/*.cpp)
  list(REMOVE_ITEM sources ${layer_EXCEPT} "")
  set(target shelfbeam_${folder})
  add_library(${target} STATIC ${sources})
  list(TRANSFORM layer_NEEDS PREPEND shelfbeam_)
  target_link_libraries(${target} PUBLIC shelfbeam_dependencies ${layer_NEEDS})
  shelfbeam_compile_fast(${target} ${sources})
  # Loops over lanes: without errno and floating-point traps the compiler may use vectors.
  set(kernels ${sources})
  list(FILTER kernels INCLUDE REGEX "_kernels[.]cpp$")
  set_source_files_properties(${kernels} PROPERTIES
    COMPILE_OPTIONS "-O3;-fno-math-errno;-fno-trapping-math" SKIP_UNITY_BUILD_INCLUSION ON)
  if(layer_IDLE)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()

  target_sources(shelfbeam_library PRIVATE $<TARGET_OBJECTS:${target}>)
  list(TRANSFORM layer_PUBLIC PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  target_sources(shelfbeam_library PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src FILES ${layer_PUBLIC})
endfunction()

# shelfbeam_compile_fast(<target> <source>...)
#
# Where CMAKE_UNITY_BUILD is on, compiles neighbouring small sources of the target as one unit: most of the compile time
# is that of the headers. Two sources of the target must therefore not define the same name, even in unnamed namespaces.
function(shelfbeam_compile_fast target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # GCC takes the sources of a unit for headers, which should not use unnamed namespaces.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
  set(group 0)
  set(unit_size 0)
  foreach(source ${ARGN})
    get_filename_component(path ${source} ABSOLUTE)
    file(SIZE ${path} size)
    math(EXPR unit_size "${unit_size} + ${size}")
    if(group EQUAL 0 OR unit_size GREATER SHELFBEAM_UNIT_SIZE)
      math(EXPR group "${group} + 1")
      set(unit_size ${size})
    endif()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()
