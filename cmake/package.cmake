# Installation: the program, the library for `find_package(shelfbeam)`, and Debian packages of both (`cpack`).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/shelfbeam)
set_target_properties(shelfbeam_library PROPERTIES EXPORT_NAME shelfbeam)

install(TARGETS shelfbeam COMPONENT program)
install(FILES data/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME shelfbeam COMPONENT program)
install(FILES data/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions
        RENAME _shelfbeam COMPONENT program)
install(FILES LICENSE README.md CHANGELOG.md CONTRIBUTING.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES data/store.schema.json data/catalogue.json DESTINATION ${CMAKE_INSTALL_DATADIR}/shelfbeam COMPONENT program)

install(TARGETS shelfbeam_library EXPORT shelfbeam
        ARCHIVE COMPONENT library FILE_SET HEADERS COMPONENT library)
install(EXPORT shelfbeam NAMESPACE shelfbeam:: FILE shelfbeamTargets.cmake DESTINATION ${config_dir} COMPONENT library)

# Links HiGHS from the system if it has one. Otherwise our own build of HiGHS is installed with the library.
set(SHELFBEAM_OWN_HIGHS "")
if(Highs_FOUND AND NOT HIGHS_LIBRARY MATCHES "^/usr/")
  get_filename_component(SHELFBEAM_OWN_HIGHS ${HIGHS_LIBRARY} NAME)
  install(FILES ${HIGHS_LIBRARY} DESTINATION ${CMAKE_INSTALL_LIBDIR}/shelfbeam COMPONENT library)
endif()
configure_package_config_file(cmake/shelfbeamConfig.cmake.in ${PROJECT_BINARY_DIR}/shelfbeamConfig.cmake
  INSTALL_DESTINATION ${config_dir} PATH_VARS CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/shelfbeamConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/shelfbeamConfig.cmake ${PROJECT_BINARY_DIR}/shelfbeamConfigVersion.cmake
        DESTINATION ${config_dir} COMPONENT library)

# The Python package, for the system's Python.
if(TARGET shelfbeam_python)
  set(python_dir lib/python3/dist-packages/shelfbeam)
  install(TARGETS shelfbeam_python LIBRARY DESTINATION ${python_dir} COMPONENT python)
  install(DIRECTORY src/python/shelfbeam/ DESTINATION ${python_dir} COMPONENT python
          FILES_MATCHING PATTERN *.py PATTERN *.pyi PATTERN py.typed PATTERN __pycache__ EXCLUDE)
endif()

# Manual pages of the program and of each verb, from --help.
find_program(SHELFBEAM_HELP2MAN help2man)
set(pages "")
if(SHELFBEAM_HELP2MAN)
  set(manual ${PROJECT_BINARY_DIR}/manual)
  set(make_pages ${PROJECT_SOURCE_DIR}/cmake/manual_pages.sh)
  add_custom_command(OUTPUT ${manual}/written
    COMMAND ${make_pages} ${SHELFBEAM_HELP2MAN} $<TARGET_FILE:shelfbeam> ${manual}
    COMMAND ${CMAKE_COMMAND} -E touch ${manual}/written
    DEPENDS shelfbeam ${make_pages} COMMENT "Writing the manual pages" VERBATIM)
  set(pages ${manual}/written)
  install(DIRECTORY ${manual}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
else()
  message(WARNING "help2man is missing (package help2man): there will be no manual pages")
endif()
add_custom_target(shelfbeam_manual_pages ALL DEPENDS ${pages})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The shelfbeam developers <shelfbeam@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program library)
if(TARGET shelfbeam_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME shelfbeam)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "${PROJECT_DESCRIPTION}")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libshelfbeam-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "${PROJECT_DESCRIPTION}: headers and static library")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-shelfbeam)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
math(EXPR next_python "${Python_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_python}), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-tqdm, python3-pandas, python3-xarray")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "${PROJECT_DESCRIPTION}: Python module")
set(shelfbeam_build_packages
  libembree-dev libtbb-dev libhdf5-dev libgeos-dev zlib1g-dev libfmt-dev)
if(CBC_FOUND)
  list(APPEND shelfbeam_build_packages coinor-libcbc-dev pkg-config)
endif()
if(Highs_FOUND AND NOT SHELFBEAM_OWN_HIGHS)
  list(APPEND shelfbeam_build_packages libhighs-dev)
endif()
list(JOIN shelfbeam_build_packages ", " CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS)
include(CPack)
