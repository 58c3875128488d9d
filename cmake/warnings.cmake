# Compile options for our own code; the headers of libraries are system headers.
add_library(shelfbeam_options INTERFACE)
target_compile_options(shelfbeam_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion
  # Clang also warns if a local name hides a name of another source of a unity build.
  $<$<CXX_COMPILER_ID:GNU>:-Wshadow>
  # Results must not depend on whether the compiler contracts a*b+c.
  -ffp-contract=off
  # Nothing replaces our functions in the Python module, so they may be inlined as in the program.
  -fno-semantic-interposition)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 falsely reports overlapping copies in std::string's operator+ (GCC bug 105651).
  target_compile_options(shelfbeam_options INTERFACE -Wno-restrict)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  # Nor does GCC warn of these: embedded files are long literals, and tests count with ints.
  target_compile_options(shelfbeam_options INTERFACE -Wno-overlength-strings -Wno-sign-conversion)
endif()
if(SHELFBEAM_SANITIZE)
  target_compile_options(shelfbeam_options INTERFACE -fsanitize=${SHELFBEAM_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(shelfbeam_options INTERFACE -fsanitize=${SHELFBEAM_SANITIZE})
  if(SHELFBEAM_SANITIZE STREQUAL thread AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # GCC warns of the fences in Asio, which the sanitizer does not see.
    target_compile_options(shelfbeam_options INTERFACE -Wno-tsan)
  endif()
endif()
if(SHELFBEAM_FUZZ)
  # Instruments the code for libFuzzer's coverage; each fuzzer links the main function itself.
  target_compile_options(shelfbeam_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
