# Configures, builds and runs the project in CONSUMER, a folder beside this file.
include(${CMAKE_CURRENT_LIST_DIR}/run_step.cmake)
file(REMOVE_RECURSE ${SCRATCH})
run_step("Configuring ${CONSUMER}" ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/${CONSUMER} -B ${SCRATCH} -G ${GENERATOR}
  -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DCMAKE_BUILD_TYPE=${BUILD_TYPE}
  -DCMAKE_PREFIX_PATH=${PREFIX} -DGNOMON_SOURCE=${SOURCE} -DGNOMON_COMPONENTS=${COMPONENTS})
run_step("Building ${CONSUMER}" ${CMAKE_COMMAND} --build ${SCRATCH})
run_step("Running ${CONSUMER}" ${SCRATCH}/consumer)
message("${step_output}")

# A shared library shows what its public headers declare and hides what is behind them.
file(GLOB_RECURSE shared ${SCRATCH}/libgnomon_shadows.so)
if(CONSUMER STREQUAL "subdirectory" AND NOT shared)
  message(FATAL_ERROR "No shared library was made.")
endif()
find_program(NM nm)
if(shared AND NM)
  run_step("Reading the names in ${shared}" ${NM} --dynamic --demangle --defined-only ${shared})
  foreach(name IN ITEMS "gnomon::shadows::classify_faces\\(" "gnomon::shadows::ShadowSystem::Frame::finish\\(")
    if(NOT step_output MATCHES "${name}")
      message(FATAL_ERROR "libgnomon_shadows.so hides ${name}, which is public.")
    endif()
  endforeach()
  foreach(name IN ITEMS "internal::BlockClassifier::" "internal::BoxTree<")
    if(step_output MATCHES "${name}")
      message(FATAL_ERROR "libgnomon_shadows.so shows ${name}, which is nobody's business.")
    endif()
  endforeach()
endif()
