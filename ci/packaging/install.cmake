# `cmake --install` and `cpack -G DEB`: libraries with their headers and CMake package, programs, cases, documents.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/cbc3d)
set(doc_dir ${CMAKE_INSTALL_DATADIR}/doc/cbc3d)

cbc3d_rooms_below(exported cbc3d_mesher cbc3d_metrics)
foreach(room ${exported})
  string(REGEX REPLACE "^cbc3d_" "" name ${room})
  set_target_properties(${room} PROPERTIES EXPORT_NAME ${name})
endforeach()
install(TARGETS ${exported} EXPORT cbc3dTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT cbc3dTargets NAMESPACE cbc3d:: DESTINATION ${package_dir})
configure_package_config_file(ci/packaging/cbc3dConfig.cmake.in ${PROJECT_BINARY_DIR}/packaging/cbc3dConfig.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/packaging/cbc3dConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/packaging/cbc3dConfig.cmake ${PROJECT_BINARY_DIR}/packaging/cbc3dConfigVersion.cmake
  DESTINATION ${package_dir})
install(CODE "set(SOURCE_DIR \"${PROJECT_SOURCE_DIR}\")
  set(HEADER_DIR \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/cbc3d\")")
install(SCRIPT ci/packaging/install_headers.cmake)

# The bench looks for its programs beside itself and for its cases in ../share/cbc3d/cases.
get_property(programs GLOBAL PROPERTY CBC3D_INSTALLED_PROGRAMS)
if(CBC3D_PROGRAMS)
  install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(DIRECTORY cases/manifests/ DESTINATION ${CMAKE_INSTALL_DATADIR}/cbc3d/cases FILES_MATCHING PATTERN "*.json")
endif()

file(GLOB_RECURSE documents RELATIVE ${PROJECT_SOURCE_DIR}
  mesher/*.md metrics/*.md baselines/*.md cases/*.md reports/*.md reports/gallery/*.jpg)
foreach(document README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff LICENSE ${documents})
  cmake_path(GET document PARENT_PATH folder)
  install(FILES ${document} DESTINATION ${doc_dir}/${folder})
endforeach()
install(FILES ci/packaging/copyright DESTINATION ${doc_dir})

if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
execute_process(COMMAND dpkg --print-architecture OUTPUT_VARIABLE architecture OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME cbc3d)
set(CPACK_PACKAGE_CONTACT "The CBC3D developers <cbc3d@example.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME cbc3d-${PROJECT_VERSION}-${architecture}.deb)
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${architecture})
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# For those who compile against the libraries, and for the pictures of a run without a screen.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "g++, cmake, libinsighttoolkit5-dev, libvtk9-dev, zlib1g-dev, libdeflate-dev, xvfb, xauth, libgl1-mesa-dri, librsvg2-bin")
include(CPack)
