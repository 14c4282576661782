# For builds without CMake: one file a component, gnomon-shadows.pc and so on. Static libraries name all that they stand on for
# whoever links; shared ones name what their headers include, and keep the rest private. Components that need what has no such
# file itself have none.
set(GNOMON_PKGCONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH prefix_from_pkgconfig /${GNOMON_PKGCONFIG_DIR} /)
string(REGEX REPLACE "/$" "" prefix_from_pkgconfig "${prefix_from_pkgconfig}")
set(pkgconfig_prefix "\${pcfiledir}/${prefix_from_pkgconfig}")
# Directories may be absolute: then they are named as they are, and the prefix cannot be found from a file in one of them.
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
  set(pkgconfig_prefix "${CMAKE_INSTALL_PREFIX}")
endif()
foreach(name IN ITEMS LIBDIR INCLUDEDIR)
  set(pkgconfig_${name} "\${prefix}/${CMAKE_INSTALL_${name}}")
  if(IS_ABSOLUTE "${CMAKE_INSTALL_${name}}")
    set(pkgconfig_${name} "${CMAKE_INSTALL_${name}}")
  endif()
endforeach()

set(without_pkgconfig)
foreach(library IN LISTS GNOMON_LIBRARIES)
  get_target_property(component ${library} EXPORT_NAME)
  get_target_property(type ${library} TYPE)
  if(type STREQUAL "INTERFACE_LIBRARY")
    get_target_property(below ${library} INTERFACE_LINK_LIBRARIES)
    set(libs)
  else()
    get_target_property(below ${library} LINK_LIBRARIES)
    set(libs "-L\${libdir} -lgnomon_${component}")
  endif()
  get_target_property(public ${library} INTERFACE_LINK_LIBRARIES)
  set(requires)
  set(requires_private)
  set(libs_private)
  set(complete TRUE)
  foreach(item IN LISTS below)
    set(list requires)
    if(type STREQUAL "SHARED_LIBRARY" AND NOT item IN_LIST public)
      set(list requires_private)
    endif()
    if(item MATCHES "^gnomon::(.+)$")
      if(CMAKE_MATCH_1 IN_LIST without_pkgconfig)
        set(complete FALSE)
      endif()
      list(APPEND ${list} gnomon-${CMAKE_MATCH_1})
    elseif(item STREQUAL "glm::glm")
      list(APPEND ${list} glm)
    elseif(item STREQUAL "fmt::fmt")
      list(APPEND ${list} fmt)
    elseif(item STREQUAL "glfw")
      list(APPEND ${list} glfw3)
    elseif(item STREQUAL "TinyGLTF::TinyGLTF")
      list(APPEND ${list} tinygltf)
    elseif(item STREQUAL CMAKE_DL_LIBS)
      string(REPLACE requires libs place ${list})
      string(APPEND ${place} " -l${item}")
    elseif(NOT item MATCHES "^(tl::expected|nlohmann_json::nlohmann_json|\\$<BUILD_INTERFACE:.*)$")  # headers alone
      set(complete FALSE)
    endif()
  endforeach()
  if(NOT complete)
    list(APPEND without_pkgconfig ${component})
    continue()
  endif()
  list(JOIN requires " " requires)
  list(JOIN requires_private " " requires_private)
  file(WRITE ${PROJECT_BINARY_DIR}/package/gnomon-${component}.pc
"prefix=${pkgconfig_prefix}
libdir=${pkgconfig_LIBDIR}
includedir=${pkgconfig_INCLUDEDIR}

Name: gnomon-${component}
Description: ${PROJECT_DESCRIPTION} (${component})
Version: ${PROJECT_VERSION}
Requires: ${requires}
Requires.private: ${requires_private}
Libs: ${libs}
Libs.private: ${libs_private}
Cflags: -I\${includedir}
")
  install(FILES ${PROJECT_BINARY_DIR}/package/gnomon-${component}.pc DESTINATION ${GNOMON_PKGCONFIG_DIR}
    COMPONENT development)
endforeach()
