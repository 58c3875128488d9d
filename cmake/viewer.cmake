# The 3-D view of reports: bundles src/viewer, its texts and three.js in one script, which is embedded in the library.
#
#   shelfbeam_viewer(<out.cpp>)   writes the source to compile; its script is empty without Node.js or its packages
#
# npm installs the packages of src/viewer/package-lock.json in the build folder. If this fails, the next configuration
# tries again. SHELFBEAM_VIEWER_PACKAGES is the folder of the packages, or empty.

function(shelfbeam_viewer_packages viewer)
  set(SHELFBEAM_VIEWER_PACKAGES "" CACHE INTERNAL "node_modules of the 3-D view")
  if(NOT SHELFBEAM_VIEWER)
    return()
  endif()
  find_program(SHELFBEAM_NODE NAMES node nodejs)
  find_program(SHELFBEAM_NPM npm)
  if(NOT SHELFBEAM_NODE OR NOT SHELFBEAM_NPM)
    message(WARNING "Node.js or npm is missing (packages nodejs, npm): reports will have no 3-D view")
    return()
  endif()
  set(home ${PROJECT_BINARY_DIR}/viewer)
  set(omit --omit=dev) # types and a WebSocket, for the tests
  if(SHELFBEAM_TESTS)
    set(omit --include=dev)
  endif()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${viewer}/package.json ${viewer}/package-lock.json)
  file(SHA256 ${viewer}/package-lock.json wanted)
  string(APPEND wanted " ${omit}")
  set(present "")
  if(EXISTS ${home}/installed.txt)
    file(READ ${home}/installed.txt present)
  endif()
  if(NOT present STREQUAL wanted)
    file(COPY ${viewer}/package.json ${viewer}/package-lock.json DESTINATION ${home})
    execute_process(
      COMMAND ${SHELFBEAM_NPM} ci ${omit} --ignore-scripts --no-audit --no-fund --loglevel=error --fetch-retries=1
      WORKING_DIRECTORY ${home} RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE why)
    if(failed)
      message(WARNING "npm could not install the packages of the 3-D view: reports will have none\n${why}")
      return()
    endif()
    file(WRITE ${home}/installed.txt "${wanted}")
  endif()
  set(SHELFBEAM_VIEWER_PACKAGES ${home}/node_modules CACHE INTERNAL "")
endfunction()

function(shelfbeam_viewer out)
  cmake_path(GET CMAKE_CURRENT_FUNCTION_LIST_DIR PARENT_PATH root)
  set(viewer ${root}/src/viewer)
  shelfbeam_viewer_packages(${viewer})
  set(script ${PROJECT_BINARY_DIR}/viewer/viewer.js)
  if(SHELFBEAM_VIEWER_PACKAGES)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${viewer}/*.ts ${viewer}/*.css)
    list(APPEND sources ${root}/src/shelfbeam/report/text/english.json ${PROJECT_BINARY_DIR}/viewer/installed.txt)
    set(make_script ${CMAKE_COMMAND} -E env NODE_PATH=${SHELFBEAM_VIEWER_PACKAGES}
      ${SHELFBEAM_NODE} ${SHELFBEAM_VIEWER_PACKAGES}/esbuild/bin/esbuild ${viewer}/main.ts --bundle --minify --format=iife
      --target=es2022 --charset=utf8 --loader:.css=text --legal-comments=inline --log-level=warning --outfile=${script})
  else()
    set(sources "")
    file(WRITE ${script}.none "")
    set(make_script ${CMAKE_COMMAND} -E copy ${script}.none ${script})
  endif()
  add_custom_command(OUTPUT ${out}
    COMMAND ${make_script}
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DSYMBOL=viewer_script -DFILE=${script} -P ${root}/cmake/embed.cmake
    DEPENDS ${sources} ${root}/cmake/embed.cmake
    COMMENT "Bundling the 3-D view" VERBATIM)
endfunction()
