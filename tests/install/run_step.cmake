cmake_minimum_required(VERSION 3.25)

# run_step(<what> COMMAND...): runs a command; when it fails, says what was being done and shows all it said.
# Its output is left in step_output.
function(run_step what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result STREQUAL "0")
    message(FATAL_ERROR "${what} failed (${result}).\n${ARGN}\n${output}")
  endif()
  set(step_output "${output}" PARENT_SCOPE)
endfunction()
