# `cpack` in the build folder makes Debian packages of what was built: gnomon, the programs, and libgnomon-dev, what building
# against gnomon needs. Shared libraries come with the programs. What a program links is looked up by dpkg-shlibdeps; what it
# opens at run time, and what components of the libraries need, is named here.
if(TARGET gnomon OR BUILD_SHARED_LIBS)  # libraries alone need no look-up
  find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
  find_program(GZIP gzip)
  mark_as_advanced(DPKG_SHLIBDEPS GZIP)
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gnomon)
set(CPACK_PACKAGE_VENDOR "the gnomon authors")
set(CPACK_PACKAGE_CONTACT "the gnomon authors <gnomon@localhost>" CACHE STRING "Who stands for the Debian packages")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "exact hard shadows by stencil shadow volumes")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL development)
if(TARGET gnomon OR BUILD_SHARED_LIBS)
  list(PREPEND CPACK_COMPONENTS_ALL runtime)
endif()
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

# The summary is the first line of either description; a line with a point alone divides paragraphs.
set(about "gnomon draws stencil shadow volumes for any triangle mesh: closed, open,
non-manifold or mirrored, from a light anywhere, seen by a camera anywhere.
Its masks equal those of traced rays but on a shadow's very edge.
.")

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME gnomon)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "${about}
This package has the programs: gnomon, which renders, inspects, measures
and makes sun studies, and gnomon-game, a game of stealth.")
if(DPKG_SHLIBDEPS)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
endif()
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "python3:any")  # gnomon-plot
# Opened at run time: a program starts without them and says what it lacks.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "libegl1 | libosmesa6, libvulkan1, mesa-vulkan-drivers | vulkan-icd")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "python3-matplotlib, libgnomon-dev")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libgnomon-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "${about}
This package has the development files: headers, libraries, and what CMake
and pkg-config read. The CPU core needs no more than this package depends
on; each further component needs some of what is recommended.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libglm-dev, libexpected-dev")
if(BUILD_SHARED_LIBS)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", gnomon (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
  set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
endif()
# As gnomonConfig.cmake.in has them, component by component.
set(recommends)
if(TARGET gnomon_gpu OR TARGET gnomon_scene)
  list(APPEND recommends libfmt-dev)
endif()
if(TARGET gnomon_scene)
  list(APPEND recommends libtinygltf-dev nlohmann-json3-dev)
endif()
if(TARGET gnomon_truth)
  list(APPEND recommends libembree-dev)
endif()
if(TARGET gnomon_gl_glfw)
  list(APPEND recommends libglfw3-dev)
endif()
list(JOIN recommends ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS)

# Debian wants the licence under this name, in each package's own folder, and a changelog of the package beside it.
if(GZIP)
  string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
  file(WRITE ${PROJECT_BINARY_DIR}/package/changelog.Debian
    "gnomon (${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium\n\n"
    "  * Made by cpack from gnomon ${PROJECT_VERSION}, whose CHANGELOG.md says what is new.\n\n"
    " -- ${CPACK_PACKAGE_CONTACT}  ${now}\n")
  execute_process(COMMAND ${GZIP} -9nf ${PROJECT_BINARY_DIR}/package/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)
  foreach(pair IN ITEMS gnomon:runtime libgnomon-dev:development)
    string(REPLACE ":" ";" pair "${pair}")
    list(GET pair 0 package)
    list(GET pair 1 component)
    install(FILES ${PROJECT_BINARY_DIR}/package/changelog.Debian.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
      COMPONENT ${component} EXCLUDE_FROM_ALL)
  endforeach()
endif()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libgnomon-dev RENAME copyright
  COMPONENT development EXCLUDE_FROM_ALL)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/gnomon RENAME copyright
  COMPONENT runtime EXCLUDE_FROM_ALL)
include(CPack)
