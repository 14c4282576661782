# What `cmake --install` puts where: the libraries that were built, their public headers, the program, and a package
# that `find_package(gnomon COMPONENTS shadows)` finds. Nothing of internal/ leaves the source tree. Two parts: `runtime` is
# what programs need, `development` what building against gnomon needs (gnomon_cpack.cmake makes a Debian package of each).
if(NOT GNOMON_INSTALL)
  return()
endif()
include(CMakePackageConfigHelpers)
set(GNOMON_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/gnomon)

set(GNOMON_COMPONENTS)
set(folders_done)
foreach(library IN LISTS GNOMON_LIBRARIES)
  get_target_property(component ${library} EXPORT_NAME)
  get_target_property(folder ${library} GNOMON_FOLDER)
  get_target_property(headers ${library} GNOMON_HEADERS)
  list(APPEND GNOMON_COMPONENTS ${component})
  install(TARGETS ${library} EXPORT gnomonTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development)
  if(NOT folder IN_LIST folders_done)
    list(APPEND folders_done ${folder})
    install(DIRECTORY ${headers}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gnomon/${folder} COMPONENT development
      FILES_MATCHING PATTERN "*.hpp" PATTERN "internal" EXCLUDE PATTERN "shaders" EXCLUDE)
  endif()
endforeach()

if(TARGET gnomon_shadow_pass)
  # For hosts whose scene is drawn by shaders of their own (docs/conventions.md, "One position function").
  install(FILES ${PROJECT_SOURCE_DIR}/modules/shadow_pass/shaders/position.glsl
    DESTINATION ${CMAKE_INSTALL_DATADIR}/gnomon/shaders COMPONENT development)
endif()

include(gnomon_pkgconfig)

install(EXPORT gnomonTargets NAMESPACE gnomon:: DESTINATION ${GNOMON_PACKAGE_DIR} COMPONENT development)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/gnomonConfig.cmake.in
  ${PROJECT_BINARY_DIR}/package/gnomonConfig.cmake INSTALL_DESTINATION ${GNOMON_PACKAGE_DIR})
# What a version promises: docs/compatibility.md. Before 1.0 a new minor version may change anything.
set(compatibility SameMajorVersion)
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(compatibility SameMinorVersion)
endif()
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/gnomonConfigVersion.cmake COMPATIBILITY ${compatibility})
install(FILES
  ${PROJECT_BINARY_DIR}/package/gnomonConfig.cmake
  ${PROJECT_BINARY_DIR}/package/gnomonConfigVersion.cmake
  DESTINATION ${GNOMON_PACKAGE_DIR} COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)

if(PROJECT_IS_TOP_LEVEL)  # what the packages of a project around gnomon are is for that project to say
  include(gnomon_cpack)
endif()
