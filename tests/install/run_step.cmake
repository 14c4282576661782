cmake_minimum_required(VERSION 3.25)

# What goes before the compiler in all that is configured from here: LAUNCHER, its words with bars between.
if(LAUNCHER)
  string(REPLACE "|" ";" words_of_launcher "${LAUNCHER}")
  set(ENV{CMAKE_CXX_COMPILER_LAUNCHER} "${words_of_launcher}")
endif()

# run_step(<what> COMMAND...): runs a command; when it fails, says what was being done and shows all it said.
# Its output is left in step_output.
function(run_step what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result STREQUAL "0")
    message(FATAL_ERROR "${what} failed (${result}).\n${ARGN}\n${output}")
  endif()
  set(step_output "${output}" PARENT_SCOPE)
endfunction()
