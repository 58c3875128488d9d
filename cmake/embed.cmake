# In script mode there is no project that sets the policies.
if(CMAKE_SCRIPT_MODE_FILE)
  cmake_minimum_required(VERSION 3.25)
endif()

# Turns files into a C++ source with one std::string_view each.
#
#   shelfbeam_embed(<out.cpp> <symbol> <file> [<symbol> <file> ...])
#   cmake -DOUT=<out.cpp> -DSYMBOL=<symbol> -DFILE=<file> -P embed.cmake     for a generated file
function(shelfbeam_embed out)
  set(text "#include <string_view>\nnamespace shelfbeam::embedded {\n")
  set(pairs ${ARGN})
  while(pairs)
    list(POP_FRONT pairs symbol file)
    if(NOT CMAKE_SCRIPT_MODE_FILE)
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    endif()
    file(READ ${file} hex HEX)
    string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${hex}")
    string(APPEND text "static const char ${symbol}_bytes[] = {${bytes}'\\0'};\n"
                       "extern const std::string_view ${symbol};\n"
                       "const std::string_view ${symbol}(${symbol}_bytes, sizeof ${symbol}_bytes - 1);\n")
  endwhile()
  string(APPEND text "}\n")
  file(CONFIGURE OUTPUT ${out} CONTENT "@text@" @ONLY)
endfunction()

# Turns files into a C++ source with the table <symbol> of their paths below <folder> and contents.
function(shelfbeam_embed_table out symbol folder)
  set(pairs)
  set(rows)
  foreach(path ${ARGN})
    string(MAKE_C_IDENTIFIER ${path} name)
    list(APPEND pairs ${name} ${folder}/${path})
    string(APPEND rows "{\"${path}\", ${name}},")
  endforeach()
  shelfbeam_embed(${out}.part ${pairs}) # written only where it differs, as ${out}
  set(type "std::pair<std::string_view, std::string_view>")
  file(READ ${out}.part text)
  file(CONFIGURE OUTPUT ${out} @ONLY CONTENT "#include <span>\n#include <utility>\n@text@\
namespace shelfbeam::embedded {\nstatic const @type@ rows[] = {@rows@};\n\
extern const std::span<const @type@> @symbol@;\nconst std::span<const @type@> @symbol@(rows);\n}\n")
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)
  shelfbeam_embed(${OUT} ${SYMBOL} ${FILE})
endif()
