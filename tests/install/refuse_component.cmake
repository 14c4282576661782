# A component that was not built, and a version that promises nothing to this one's users, have to be refused, when configuring.
function(refuse what request expected)
  file(REMOVE_RECURSE ${SCRATCH})
  file(WRITE ${SCRATCH}/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(consumer LANGUAGES CXX)
find_package(${request})
")
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SCRATCH} -B ${SCRATCH}/build -G ${GENERATOR}
      -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${PREFIX}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(result EQUAL 0)
    message(FATAL_ERROR "${what} was found.")
  endif()
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(NOT output MATCHES "${expected}")
    message(FATAL_ERROR "The refusal of ${what} does not say ${expected}: ${output}")
  endif()
endfunction()

refuse("a component that does not exist" "gnomon REQUIRED COMPONENTS sundial"
  "gnomon was built without its component sundial; it has: core")
string(REGEX MATCH "^([0-9]+)\\.([0-9]+)" unused ${VERSION})
math(EXPR next "${CMAKE_MATCH_2} + 1")
refuse("a later minor version" "gnomon ${CMAKE_MATCH_1}.${next} REQUIRED COMPONENTS shadows" "compatible with requested version")
