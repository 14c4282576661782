# Builds everything that is installed as shared libraries, and the programs, without tests: then what is private is hidden. Draws
# a picture from the installed program; where Debian's tools are, looks at the packages of that build as well.
include(${CMAKE_CURRENT_LIST_DIR}/run_step.cmake)
set(build ${SCRATCH}/build)
set(prefix ${SCRATCH}/prefix)
file(REMOVE_RECURSE ${SCRATCH})
# How well it is compiled is not the question.
run_step("Configuring shared libraries" ${CMAKE_COMMAND} -S ${SOURCE} -B ${build} -G ${GENERATOR} -DBUILD_SHARED_LIBS=ON
  -DGNOMON_TESTS=OFF -DGNOMON_EXAMPLES=OFF -DGNOMON_GL=${GL} -DGNOMON_VK=${VK} -DGNOMON_TRUTH=${TRUTH} -DCMAKE_BUILD_TYPE=
  -DCMAKE_CXX_COMPILER=${COMPILER})
run_step("Building shared libraries and programs" ${CMAKE_COMMAND} --build ${build})
run_step("Installing shared libraries and programs" ${CMAKE_COMMAND} --install ${build} --prefix ${prefix})
file(RENAME ${build} ${build}_away)  # what is installed has to stand by itself
run_step("Drawing with the installed program" ${prefix}/${BINDIR}/gnomon render builtin:pillars --size 64x64
  --out ${SCRATCH}/pillars.png)
file(RENAME ${build}_away ${build})
file(READ ${SCRATCH}/pillars.png signature LIMIT 8 HEX)
if(NOT signature STREQUAL "89504e470d0a1a0a")
  message(FATAL_ERROR "pillars.png is no PNG: it begins with ${signature}")
endif()
if(DPKG_DEB)
  set(SHARED TRUE)
  set(BUILD ${build})
  set(SCRATCH ${SCRATCH}/packages)
  include(${CMAKE_CURRENT_LIST_DIR}/debian_packages.cmake)
endif()
