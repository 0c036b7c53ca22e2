# What `cmake --install` puts where: the program, the library with its headers and packages, and the data both read.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Two sets of targets: vlbeam::core, the element library alone, and all the rest, vlbeam::vlbeam.
set_target_properties(vlbeam_core PROPERTIES EXPORT_NAME core)
set_target_properties(vlbeam_library PROPERTIES EXPORT_NAME vlbeam)
set_target_properties(vlbeam_mechanics PROPERTIES EXPORT_NAME mechanics)
set_target_properties(vlbeam_scene PROPERTIES EXPORT_NAME scene)
set_target_properties(vlbeam_io PROPERTIES EXPORT_NAME io)
set_target_properties(vlbeam_tools PROPERTIES EXPORT_NAME tools)
set_target_properties(vlbeam_harness PROPERTIES EXPORT_NAME harness)
install(TARGETS vlbeam_core EXPORT vlbeamCoreTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS vlbeam_library vlbeam_mechanics vlbeam_scene vlbeam_io vlbeam_tools vlbeam_harness EXPORT vlbeamTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(VLBEAM_BUILD_STUDIES)
  install(TARGETS vlbeam RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

if(VLBEAM_BUILD_STUDIES)
  add_custom_target(vlbeam_program DEPENDS vlbeam)  # all that `make build` makes, and is installed
  # Man pages of the program and of each of its commands, from what --help says.
  find_program(HELP2MAN help2man)
  if(HELP2MAN)
    set(pages ${PROJECT_BINARY_DIR}/man)
    add_custom_command(
      OUTPUT ${pages}/vlbeam.1
      COMMAND ${PROJECT_SOURCE_DIR}/cmake/man_pages.sh ${HELP2MAN} $<TARGET_FILE:vlbeam> ${pages}
      DEPENDS vlbeam ${PROJECT_SOURCE_DIR}/cmake/man_pages.sh
      VERBATIM)
    add_custom_target(vlbeam_man ALL DEPENDS ${pages}/vlbeam.1)
    add_dependencies(vlbeam_program vlbeam_man)
    install(DIRECTORY ${pages}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  else()
    install(CODE "message(STATUS \"No man pages: help2man is not installed\")")
  endif()
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/completion.bash
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME vlbeam)
endif()

set(packages ${CMAKE_INSTALL_LIBDIR}/cmake/vlbeam)
install(EXPORT vlbeamCoreTargets NAMESPACE vlbeam:: DESTINATION ${packages})
install(EXPORT vlbeamTargets NAMESPACE vlbeam:: DESTINATION ${packages})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/vlbeamConfig.cmake.in ${PROJECT_BINARY_DIR}/vlbeamConfig.cmake
                              INSTALL_DESTINATION ${packages})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/vlbeamConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vlbeamConfig.cmake ${PROJECT_BINARY_DIR}/vlbeamConfigVersion.cmake
        DESTINATION ${packages})
file(RELATIVE_PATH VLBEAM_PC_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" VLBEAM_PC_PREFIX "${VLBEAM_PC_PREFIX}")
set(VLBEAM_PC_FLAGS)
if(VLBEAM_NATIVE)
  set(VLBEAM_PC_FLAGS -march=native)
endif()
set(VLBEAM_PC_LIBRARIES)
if(TBB_FOUND)
  set(VLBEAM_PC_LIBRARIES -ltbb)
endif()
if(VLBEAM_SUNDIALS)
  string(APPEND VLBEAM_PC_LIBRARIES " -lsundials_arkode -lsundials_cvode -lsundials_ida -lsundials_nvecserial -lsundials_sunmatrixdense")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/vlbeam.pc.in ${PROJECT_BINARY_DIR}/vlbeam.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/vlbeam.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# Headers name each other by where they stand in the sources; installed, all of them stand below vlbeam/.
set(headers ${PROJECT_BINARY_DIR}/installed-headers)
install(CODE "execute_process(COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DHEADERS=${headers}
                              -P ${CMAKE_CURRENT_LIST_DIR}/gather_headers.cmake COMMAND_ERROR_IS_FATAL ANY)")
install(DIRECTORY ${headers}/vlbeam DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

set(data ${CMAKE_INSTALL_DATADIR}/vlbeam)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes ${PROJECT_SOURCE_DIR}/examples DESTINATION ${data})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/studies DESTINATION ${data}
        FILES_MATCHING PATTERN "*.json" PATTERN "*.gp" PATTERN "README.md"
        PATTERN app EXCLUDE PATTERN harness EXCLUDE PATTERN site EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/reference DESTINATION ${data} FILES_MATCHING PATTERN "*.json" PATTERN "*.csv")
# Documents stand to each other as in the sources, so that their links lead somewhere, the report site with them.
foreach(file README.md LICENSE CHANGELOG.md CONTRIBUTING.md CITATION.cff)
  install(FILES ${PROJECT_SOURCE_DIR}/${file} DESTINATION ${CMAKE_INSTALL_DOCDIR})
endforeach()
foreach(folder core mechanics scene io tools docs examples python/examples reference reports scenes studies tests/mutants)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder}/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder}
          FILES_MATCHING PATTERN "*.md" PATTERN "*.html" PATTERN "*.css" PATTERN "*.js" PATTERN "*.svg"
          PATTERN "*.json" PATTERN "*.csv" PATTERN "*.ipynb"
          PATTERN "*.kept" EXCLUDE PATTERN "*.timing.json" EXCLUDE PATTERN "CMakeFiles" EXCLUDE PATTERN "__pycache__" EXCLUDE)
endforeach()
foreach(folder examples python/examples docs)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder}/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder}
          FILES_MATCHING PATTERN "*.cpp" PATTERN "*.py")
endforeach()

# What is installed is built by name (make build, make package): cpack does not build all tests before.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)

# make package: a Debian package, build/vlbeam_VERSION_ARCHITECTURE.deb
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The vlbeam developers")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox, libeigen3-dev, libboost-dev, nlohmann-json3-dev, libtbb-dev")
set(CPACK_STRIP_FILES ON)
include(CPack)
