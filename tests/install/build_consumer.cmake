# Configures, builds and runs the project in CONSUMER, a folder beside this file.
include(${CMAKE_CURRENT_LIST_DIR}/run_step.cmake)
file(REMOVE_RECURSE ${SCRATCH})
run_step("Configuring ${CONSUMER}" ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/${CONSUMER} -B ${SCRATCH} -G ${GENERATOR}
  -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DCMAKE_BUILD_TYPE=${BUILD_TYPE}
  -DCMAKE_PREFIX_PATH=${PREFIX} -DGNOMON_SOURCE=${SOURCE} -DGNOMON_COMPONENTS=${COMPONENTS})
run_step("Building ${CONSUMER}" ${CMAKE_COMMAND} --build ${SCRATCH})
run_step("Running ${CONSUMER}" ${SCRATCH}/consumer)
message("${step_output}")
