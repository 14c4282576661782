# How every library target of gnomon is made. Folder = target = namespace.

set(GNOMON_INCLUDE_ROOT ${PROJECT_BINARY_DIR}/include)
set(GNOMON_LIBRARIES "" CACHE INTERNAL "every library target, for the install rules")
set(GNOMON_SHADER_ROOT ${PROJECT_BINARY_DIR}/generated)

if(PROJECT_IS_TOP_LEVEL)
  if(NOT CMAKE_RUNTIME_OUTPUT_DIRECTORY)
    set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  endif()
  find_program(GNOMON_CCACHE ccache)
  if(GNOMON_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    # The same file is one file in whatever clone it is compiled; and what includes a precompiled header is kept as well.
    set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
      CCACHE_SLOPPINESS=pch_defines,time_macros ${GNOMON_CCACHE})
  endif()
endif()

# Shared libraries find each other, and programs find them, wherever the prefix was moved to.
if(BUILD_SHARED_LIBS AND PROJECT_IS_TOP_LEVEL AND NOT CMAKE_INSTALL_RPATH)
  file(RELATIVE_PATH libraries_from_programs ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/${libraries_from_programs}")
endif()

# Of shared libraries: what is compatible with what (docs/compatibility.md). Before 1.0 that is a minor version.
set(GNOMON_SOVERSION ${PROJECT_VERSION_MAJOR})
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(GNOMON_SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
endif()

option(GNOMON_CHECKED "A caller's bug aborts with a sentence in optimised builds too (gnomon/core/expects.hpp)" OFF)

add_library(gnomon_compile_options INTERFACE)
target_compile_features(gnomon_compile_options INTERFACE cxx_std_20)
# -ffp-contract=off: the compiler must not fuse a*b+c, or builds would differ in their last bits.
target_compile_options(gnomon_compile_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -ffp-contract=off
  $<$<BOOL:${GNOMON_WERROR}>:-Werror>
)
if(GNOMON_CHECKED)
  target_compile_definitions(gnomon_compile_options INTERFACE GNOMON_CHECKED)
endif()
# GCC 12.2, from -O2 on, forgets to round where it vectorises double -> float -> double in straight-line code: a light
# "rounded once" would not be rounded everywhere (tests/shadows/rounding_test.cpp).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(gnomon_compile_options INTERFACE -fno-tree-slp-vectorize)
endif()
# GCC 12 sees overlaps in std::string's operator+ that are not there (GCC bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(gnomon_compile_options INTERFACE -Wno-restrict)
endif()
# To GCC every source of a unity build is an included file, whose anonymous namespaces should not be in types.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(gnomon_compile_options INTERFACE -Wno-subobject-linkage)
endif()
# Sizes of 64 bits become sizes of 32 there, on purpose.
if(EMSCRIPTEN)
  target_compile_options(gnomon_compile_options INTERFACE -Wno-shorten-64-to-32 -Wno-sign-conversion)
endif()
if(GNOMON_SANITIZE)
  target_compile_options(gnomon_compile_options INTERFACE
    -fsanitize=${GNOMON_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    # GCC sees uninitialised values in <regex> and others where the sanitizers have added branches.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(gnomon_compile_options INTERFACE -fsanitize=${GNOMON_SANITIZE})
endif()
if(GNOMON_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "GNOMON_FUZZ needs clang, whose libFuzzer it uses; the compiler is ${CMAKE_CXX_COMPILER_ID}")
  endif()
  # Coverage of everything that the fuzz targets reach; their main() comes with -fsanitize=fuzzer (tests/fuzz).
  target_compile_options(gnomon_compile_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# gnomon_add_library(<name> [INTERNAL] SOURCES ... [PUBLIC deps...] [PRIVATE deps...])
# makes target gnomon_<name>, alias gnomon::<name>, from the folder that calls it. Its public headers are the
# folder's *.hpp files, reached as <gnomon/<name>/file.hpp>; what lies in internal/ is not installed. INTERNAL: it serves the
# programs and is no part of the package.
function(gnomon_add_library name)
  cmake_parse_arguments(ARG "INTERNAL" "FOLDER" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(kind)
  if(ARG_INTERNAL)
    set(kind STATIC)
  endif()
  if(NOT ARG_FOLDER)
    set(ARG_FOLDER ${name})
  endif()
  file(MAKE_DIRECTORY ${GNOMON_INCLUDE_ROOT}/gnomon)
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${GNOMON_INCLUDE_ROOT}/gnomon/${ARG_FOLDER} SYMBOLIC)

  if(ARG_SOURCES)
    add_library(gnomon_${name} ${kind} ${ARG_SOURCES})
    target_include_directories(gnomon_${name} PUBLIC
      $<BUILD_INTERFACE:${GNOMON_INCLUDE_ROOT}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    # For sources in folders below, which name the module's internal headers as those beside them do.
    target_include_directories(gnomon_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
    target_compile_features(gnomon_${name} PUBLIC cxx_std_20)
    target_link_libraries(gnomon_${name} PRIVATE $<BUILD_INTERFACE:gnomon_compile_options>)
    target_link_libraries(gnomon_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
    set_target_properties(gnomon_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    if(BUILD_SHARED_LIBS AND NOT ARG_INTERNAL)
      # What public headers declare is seen from outside (gnomon/core/export.hpp), nothing else. The tests look inside.
      set_target_properties(gnomon_${name} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${GNOMON_SOVERSION})
      if(NOT GNOMON_TESTS)
        set_target_properties(gnomon_${name} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
      endif()
    endif()
  else()
    add_library(gnomon_${name} INTERFACE)
    target_include_directories(gnomon_${name} INTERFACE
      $<BUILD_INTERFACE:${GNOMON_INCLUDE_ROOT}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_compile_features(gnomon_${name} INTERFACE cxx_std_20)
    target_link_libraries(gnomon_${name} INTERFACE ${ARG_PUBLIC})
  endif()
  add_library(gnomon::${name} ALIAS gnomon_${name})
  set_target_properties(gnomon_${name} PROPERTIES EXPORT_NAME ${name}
    GNOMON_FOLDER ${ARG_FOLDER} GNOMON_HEADERS ${CMAKE_CURRENT_SOURCE_DIR})
  if(NOT ARG_INTERNAL)
    set(GNOMON_LIBRARIES ${GNOMON_LIBRARIES} gnomon_${name} CACHE INTERNAL "")
  endif()
endfunction()

# gnomon_add_shaders(<target> <name> <file>...)
# turns GLSL (Vulkan dialect) in the caller's shaders/ into one header <gnomon_shaders/name.hpp> that holds, per file,
# the SPIR-V for Vulkan and the desktop GLSL for GL that SPIRV-Cross makes from that very SPIR-V, as
# gnomon::<name>::shaders::<file with dots as underscores>. Files that end in .glsl are only included by others.
# For the web the header holds the WGSL instead, <file>.wgsl beside <file>, with what it includes.
function(gnomon_add_shaders target name)
  set(header ${GNOMON_SHADER_ROOT}/gnomon_shaders/${name}.hpp)
  set(position ${PROJECT_SOURCE_DIR}/modules/shadow_pass/shaders)
  set(sources)
  set(includes)
  set(languages spirv,glsl)
  if(EMSCRIPTEN)
    set(languages wgsl)
  endif()
  file(GLOB wgsl CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/shaders/*.wgsl ${position}/*.wgsl)
  foreach(file IN LISTS ARGN)
    if(file MATCHES "\\.glsl$")
      list(APPEND includes ${CMAKE_CURRENT_SOURCE_DIR}/shaders/${file})
    else()
      list(APPEND sources ${CMAKE_CURRENT_SOURCE_DIR}/shaders/${file})
    endif()
  endforeach()
  string(REPLACE ";" "," joined "${sources}")
  add_custom_command(OUTPUT ${header}
    COMMAND ${CMAKE_COMMAND} -DHEADER=${header} -DSHADERS=${joined} -DNAME=${name}
      -DLANGUAGES=${languages}
      -DINCLUDES=-I${position},-I${CMAKE_CURRENT_SOURCE_DIR}/shaders
      -DGLSLANG=${GLSLANG_VALIDATOR} -DSPIRV_CROSS=${SPIRV_CROSS}
      -P ${PROJECT_SOURCE_DIR}/cmake/compile_shaders.cmake
    DEPENDS ${sources} ${includes} ${wgsl} ${position}/position.glsl ${PROJECT_SOURCE_DIR}/cmake/compile_shaders.cmake
    COMMENT "Compiling the shaders of ${name}" VERBATIM)
  add_custom_target(${target}_shaders DEPENDS ${header})
  add_dependencies(${target} ${target}_shaders)
  target_include_directories(${target} PRIVATE ${GNOMON_SHADER_ROOT})
endfunction()
