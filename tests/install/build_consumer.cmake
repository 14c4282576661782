# Configures, builds and runs the project in CONSUMER, a folder beside this file.
include(${CMAKE_CURRENT_LIST_DIR}/run_step.cmake)
file(REMOVE_RECURSE ${SCRATCH})
run_step("Configuring ${CONSUMER}" ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/${CONSUMER} -B ${SCRATCH} -G ${GENERATOR}
  -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=${BUILD_TYPE}
  -DCMAKE_PREFIX_PATH=${PREFIX} -DGNOMON_SOURCE=${SOURCE} -DGNOMON_COMPONENTS=${COMPONENTS})
run_step("Building ${CONSUMER}" ${CMAKE_COMMAND} --build ${SCRATCH})
run_step("Running ${CONSUMER}" ${SCRATCH}/consumer)
message("${step_output}")

# What the core's headers include: nothing of a GPU's, a window's or a text formatter's, as on a machine that has none of them.
if(CONSUMER STREQUAL "package_shadows")
  run_step("Listing what ${CONSUMER} includes" ${COMPILER} -std=c++20 -M -I${PREFIX}/include
    ${CMAKE_CURRENT_LIST_DIR}/closed_volume.cpp)
  if(NOT step_output MATCHES "/gnomon/shadows/shadow_mesh\\.hpp" OR NOT step_output MATCHES "/glm/")
    message(FATAL_ERROR "The list of what is included lacks what certainly is: ${step_output}")
  endif()
  if(step_output MATCHES "[^ \n]*/(GL|KHR|EGL|GLFW|vulkan|fmt|nlohmann|gnomon/gpu|gnomon/gl|gnomon/vk)/[^ \n]*")
    message(FATAL_ERROR "The CPU core includes ${CMAKE_MATCH_0}")
  endif()
endif()

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
