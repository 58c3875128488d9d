# The pages: bundles src/page, its texts and three.js, which are embedded in the library.
#
#   shelfbeam_page(<viewer.cpp> <planner.cpp>)   writes the sources to compile: the script of the 3-D view of reports,
#                                                and the files of the planner. Both are empty without Node.js or its
#                                                packages.
#
# npm installs the packages of src/page/package-lock.json in the build folder. If this fails, the next configuration
# tries again. SHELFBEAM_VIEWER_PACKAGES is the folder of the packages, or empty.

function(shelfbeam_page_packages page)
  set(SHELFBEAM_VIEWER_PACKAGES "" CACHE INTERNAL "node_modules of the pages")
  if(NOT SHELFBEAM_VIEWER)
    return()
  endif()
  find_program(SHELFBEAM_NODE NAMES node nodejs)
  find_program(SHELFBEAM_NPM npm)
  if(NOT SHELFBEAM_NODE OR NOT SHELFBEAM_NPM)
    message(WARNING "Node.js or npm is missing (packages nodejs, npm): reports will have no 3-D view, and there will be no planner")
    return()
  endif()
  set(home ${PROJECT_BINARY_DIR}/page)
  set(omit --omit=dev) # types, and what drives a browser, for the tests
  if(SHELFBEAM_TESTS)
    set(omit --include=dev)
  endif()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page}/package.json ${page}/package-lock.json)
  file(SHA256 ${page}/package-lock.json wanted)
  string(APPEND wanted " ${omit}")
  set(present "")
  if(EXISTS ${home}/installed.txt)
    file(READ ${home}/installed.txt present)
  endif()
  if(NOT present STREQUAL wanted)
    file(COPY ${page}/package.json ${page}/package-lock.json DESTINATION ${home})
    execute_process(
      COMMAND ${SHELFBEAM_NPM} ci ${omit} --ignore-scripts --no-audit --no-fund --loglevel=error --fetch-retries=1
      WORKING_DIRECTORY ${home} RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE why)
    if(failed)
      message(WARNING "npm could not install the packages of the pages: reports will have no 3-D view, and there will be no planner\n${why}")
      return()
    endif()
    file(WRITE ${home}/installed.txt "${wanted}")
  endif()
  set(SHELFBEAM_VIEWER_PACKAGES ${home}/node_modules CACHE INTERNAL "")
endfunction()

function(shelfbeam_page viewer_cpp planner_cpp)
  cmake_path(GET CMAKE_CURRENT_FUNCTION_LIST_DIR PARENT_PATH root)
  set(page ${root}/src/page)
  set(out ${PROJECT_BINARY_DIR}/page)
  shelfbeam_page_packages(${page})
  if(SHELFBEAM_VIEWER_PACKAGES)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${page}/*.ts ${page}/*.css ${page}/*.html ${page}/*.json ${page}/*.svg)
    list(APPEND sources ${page}/bundle.mjs ${root}/src/shelfbeam/report/text/english.json ${root}/src/shelfbeam/report/page/colours.css
      ${root}/data/store.schema.json ${out}/installed.txt)
    set(bundle ${SHELFBEAM_NODE} ${page}/bundle.mjs ${SHELFBEAM_VIEWER_PACKAGES} ${out})
    set(cmaps ${SHELFBEAM_VIEWER_PACKAGES}/pdfjs-dist/cmaps)
    file(GLOB maps RELATIVE ${cmaps} ${cmaps}/*.bcmap) # the character maps that bundle.mjs copies
    list(FILTER maps EXCLUDE REGEX "UTF(8|32)")
    list(TRANSFORM maps PREPEND pdf/)
    set(files index.html icon.svg planner.js style.css dxf/worker.js table/table.js
      pdf/pdf.js pdf/worker.js pdf/jbig2.wasm pdf/openjpeg.wasm pdf/qcms_bg.wasm
      pdf/FoxitDingbats.pfb pdf/FoxitFixed.pfb pdf/FoxitFixedBold.pfb pdf/FoxitFixedBoldItalic.pfb
      pdf/FoxitFixedItalic.pfb pdf/FoxitSerif.pfb pdf/FoxitSerifBold.pfb pdf/FoxitSerifBoldItalic.pfb
      pdf/FoxitSerifItalic.pfb pdf/FoxitSymbol.pfb pdf/LiberationSans-Regular.ttf pdf/LiberationSans-Bold.ttf
      pdf/LiberationSans-Italic.ttf pdf/LiberationSans-BoldItalic.ttf ${maps})
  else()
    set(sources "")
    file(WRITE ${out}/none "")
    set(bundle ${CMAKE_COMMAND} -E copy ${out}/none ${out}/viewer.js)
    set(files "")
  endif()
  add_custom_command(OUTPUT ${viewer_cpp} ${planner_cpp}
    COMMAND ${bundle}
    COMMAND ${CMAKE_COMMAND} -DOUT=${viewer_cpp} -DSYMBOL=viewer_script -DFILE=${out}/viewer.js -P ${root}/cmake/embed.cmake
    COMMAND ${CMAKE_COMMAND} -DOUT=${planner_cpp} -DSYMBOL=planner_files -DFOLDER=${out}/planner "-DFILES=${files}"
      -P ${root}/cmake/embed.cmake
    DEPENDS ${sources} ${root}/cmake/embed.cmake
    COMMENT "Bundling the pages" VERBATIM)
  add_custom_target(shelfbeam_page_sources DEPENDS ${viewer_cpp} ${planner_cpp})
endfunction()
