# Turns files into a C++ source with one std::string_view each.
#
#   shelfbeam_embed(<out.cpp> <symbol> <file> [<symbol> <file> ...])
function(shelfbeam_embed out)
  set(text "#include <string_view>\nnamespace shelfbeam::embedded {\n")
  set(pairs ${ARGN})
  while(pairs)
    list(POP_FRONT pairs symbol file)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} hex HEX)
    string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${hex}")
    string(APPEND text "static const char ${symbol}_bytes[] = {${bytes}};\n"
                       "extern const std::string_view ${symbol};\n"
                       "const std::string_view ${symbol}(${symbol}_bytes, sizeof ${symbol}_bytes);\n")
  endwhile()
  string(APPEND text "}\n")
  file(CONFIGURE OUTPUT ${out} CONTENT "@text@" @ONLY)
endfunction()
