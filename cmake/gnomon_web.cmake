# What gnomon is built from by Emscripten: the headers of the same Debian packages. Their CMake configurations lead to
# /usr/include, which holds the C library of this machine's processor; so the headers that are wanted are linked into a
# folder of their own, and what has to be compiled is compiled here.

set(GNOMON_WEB_INCLUDE_DIR ${PROJECT_BINARY_DIR}/packages/include)
file(MAKE_DIRECTORY ${GNOMON_WEB_INCLUDE_DIR})

# gnomon_header_package(<target> <package> <path in /usr/include>...)
function(gnomon_header_package target package)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${GNOMON_WEB_INCLUDE_DIR})
  foreach(path IN LISTS ARGN)
    if(NOT EXISTS /usr/include/${path})
      message(FATAL_ERROR "/usr/include/${path} was not found (package ${package})")
    endif()
    get_filename_component(name ${path} NAME)
    file(CREATE_LINK /usr/include/${path} ${GNOMON_WEB_INCLUDE_DIR}/${name} SYMBOLIC)
  endforeach()
endfunction()

gnomon_header_package(glm::glm libglm-dev glm)
gnomon_header_package(tl::expected libexpected-dev tl)
gnomon_header_package(fmt::fmt libfmt-dev fmt)
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
gnomon_header_package(nlohmann_json::nlohmann_json nlohmann-json3-dev nlohmann)
gnomon_header_package(gnomon_tinygltf_headers libtinygltf-dev tiny_gltf.h)
gnomon_header_package(gnomon_stb_headers libstb-dev stb/stb_image.h)

# libc++ 13 lacks some of C++20.
include_directories(BEFORE SYSTEM ${CMAKE_CURRENT_LIST_DIR}/emscripten/include)

file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/packages/tiny_gltf.cpp CONTENT [[
#define STB_IMAGE_IMPLEMENTATION
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>
]])
add_library(gnomon_tinygltf STATIC ${PROJECT_BINARY_DIR}/packages/tiny_gltf.cpp)
target_compile_features(gnomon_tinygltf PUBLIC cxx_std_20)
target_compile_definitions(gnomon_tinygltf PUBLIC TINYGLTF_NO_STB_IMAGE_WRITE)
target_link_libraries(gnomon_tinygltf PUBLIC gnomon_tinygltf_headers
  PRIVATE gnomon_stb_headers nlohmann_json::nlohmann_json)
add_library(TinyGLTF::TinyGLTF ALIAS gnomon_tinygltf)

# Emscripten's own scripts need modules that Debian keeps where only Debian's node looks by itself.
set(CMAKE_CXX_LINKER_LAUNCHER ${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs)

# Exceptions by WebAssembly's own instructions: functions that JavaScript wraps around calls could not be suspended.
add_compile_options(-fwasm-exceptions)
add_link_options(-fwasm-exceptions)

# What is downloaded says nothing of the machine that it was made on.
add_compile_options(-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=)

# gnomon_add_web_program(<name> SOURCES ... LIBRARIES ...): an ES module, <name>.mjs and <name>.wasm, whose default export
# makes an instance. WITHOUT_FILES: nor is there a file system in it.
function(gnomon_add_web_program name)
  cmake_parse_arguments(ARG "WITHOUT_FILES" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE gnomon_compile_options ${ARG_LIBRARIES})
  if(ARG_WITHOUT_FILES)
    gnomon_link_for_the_web(${name} WITHOUT_FILES)
  else()
    gnomon_link_for_the_web(${name})
  endif()
endfunction()

function(gnomon_link_for_the_web target)
  set(files -sFILESYSTEM=1 -sEXPORTED_RUNTIME_METHODS=FS,ENV,UTF8ToString,stringToUTF8,lengthBytesUTF8)
  if("WITHOUT_FILES" IN_LIST ARGN)
    set(files -sFILESYSTEM=0 -sEXPORTED_RUNTIME_METHODS=UTF8ToString)
  endif()
  set_target_properties(${target} PROPERTIES SUFFIX .mjs)
  target_link_options(${target} PRIVATE
    -sMODULARIZE=1 -sEXPORT_ES6=1 -sENVIRONMENT=web,worker -sALLOW_MEMORY_GROWTH=1
    -sTOTAL_STACK=1MB -sINVOKE_RUN=0 -sEXIT_RUNTIME=0 ${files})
endfunction()
