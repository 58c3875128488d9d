# In script mode there is no project that sets the policies.
if(CMAKE_SCRIPT_MODE_FILE)
  cmake_minimum_required(VERSION 3.25)
endif()

# Turns files into a C++ source with one std::string_view each.
#
#   shelfbeam_embed(<out.cpp> <symbol> <file> [<symbol> <file> ...])
#   cmake -DOUT=<out.cpp> -DSYMBOL=<symbol> -DFILE=<file> -P embed.cmake     for a generated file
#   cmake -DOUT=<out.cpp> -DSYMBOL=<symbol> -DFOLDER=<folder> -DFILES=<names> -P embed.cmake     for generated pages
function(shelfbeam_embed out)
  set(text "#include <string_view>\nnamespace shelfbeam::embedded {\n")
  set(pairs ${ARGN})
  while(pairs)
    list(POP_FRONT pairs symbol file)
    if(NOT CMAKE_SCRIPT_MODE_FILE)
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    endif()
    file(READ ${file} hex HEX)
    # Compilers read one literal ten times as fast as a list of characters.
    string(REGEX REPLACE "(..)" "\\\\x\\1\"\"" bytes "${hex}")
    string(APPEND text "static const char ${symbol}_bytes[] = \"${bytes}\";\n"
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

# Turns files of a page, compressed by gzip as <folder>/<name>.gz, into a C++ source with the table <symbol> of their
# names, media types and bytes.
function(shelfbeam_embed_page out symbol folder)
  set(types_html "text/html; charset=utf-8")
  set(types_css "text/css; charset=utf-8")
  set(types_svg "image/svg+xml")
  set(types_js "text/javascript; charset=utf-8")
  set(types_wasm "application/wasm")
  set(types_pfb "application/octet-stream")
  set(types_bcmap "application/octet-stream")
  set(types_ttf "font/ttf")
  set(pairs)
  set(rows)
  foreach(name ${ARGN})
    string(MAKE_C_IDENTIFIER ${name} id)
    string(REGEX REPLACE ".*\\." "" suffix ${name})
    list(APPEND pairs ${id} ${folder}/${name}.gz)
    string(APPEND rows "{{\"${name}\", \"${types_${suffix}}\", ${id}}},")
  endforeach()
  list(LENGTH ARGN count)
  shelfbeam_embed(${out}.part ${pairs})
  set(type "std::array<std::string_view, 3>")
  file(READ ${out}.part text)
  file(CONFIGURE OUTPUT ${out} @ONLY CONTENT "#include <array>\n#include <span>\n@text@\
namespace shelfbeam::embedded {\nstatic const std::array<@type@, @count@> rows{{@rows@}};\n\
extern const std::span<const @type@> @symbol@;\nconst std::span<const @type@> @symbol@(rows);\n}\n")
endfunction()

if(CMAKE_SCRIPT_MODE_FILE AND DEFINED FOLDER)
  shelfbeam_embed_page(${OUT} ${SYMBOL} ${FOLDER} ${FILES})
elseif(CMAKE_SCRIPT_MODE_FILE)
  shelfbeam_embed(${OUT} ${SYMBOL} ${FILE})
endif()
