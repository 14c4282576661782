# The core-only preset must not even look for a GPU library, a window or a text formatter. CMake's own trace tells what
# it looks for: every find_* call that gnomon's files make.
include(${CMAKE_CURRENT_LIST_DIR}/run_step.cmake)

# looked_for(<out> <preset> <cmake arguments...>): what configuring with the preset looks for, sorted.
function(looked_for out preset)
  set(build ${SCRATCH}/${preset})
  file(REMOVE_RECURSE ${build})
  file(MAKE_DIRECTORY ${SCRATCH})
  run_step("Configuring ${preset}" ${CMAKE_COMMAND} -S ${SOURCE} --preset ${preset} -B ${build}
    -DCMAKE_CXX_COMPILER=${COMPILER} --trace-expand --trace-format=json-v1 --trace-redirect=${SCRATCH}/${preset}.trace
    ${ARGN})
  file(STRINGS ${SCRATCH}/${preset}.trace calls REGEX
    "\"cmd\":\"find_(package|path|library|program|file)\"|\"cmd\":\"pkg_(check|search)_module[s]?\"")
  set(names)
  foreach(call IN LISTS calls)
    string(JSON command GET "${call}" cmd)
    string(JSON file GET "${call}" file)
    string(FIND "${file}" "${SOURCE}/" at)
    if(NOT at EQUAL 0)
      continue()  # what found packages and CMake look for is their own business
    endif()
    string(JSON name GET "${call}" args 0)
    if(NOT command STREQUAL "find_package")
      string(JSON name GET "${call}" args 1)
    endif()
    list(APPEND names ${name})
  endforeach()
  list(REMOVE_DUPLICATES names)
  list(SORT names)
  set(${out} "${names}" PARENT_SCOPE)
endfunction()

looked_for(core core-only -DGNOMON_TESTS=OFF)
if(NOT core STREQUAL "ccache;glm;tl-expected")
  message(FATAL_ERROR "The core alone looks for ${core}, where ccache;glm;tl-expected was expected.")
endif()
looked_for(core_with_tests core-only)
if(NOT core_with_tests STREQUAL "CGAL;GTest;ccache;glm;tl-expected")
  message(FATAL_ERROR "The core and its tests look for ${core_with_tests}.")
endif()
# The proof that this test would see it: the whole library does look for more.
if(WHOLE)
  looked_for(whole release)
  foreach(name IN ITEMS fmt glslangValidator)
    if(NOT name IN_LIST whole)
      message(FATAL_ERROR "The whole library was expected to look for ${name}; it looks for ${whole}.")
    endif()
  endforeach()
endif()
