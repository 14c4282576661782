# Makes the Debian packages of this build, looks at what they say and hold, and builds and runs a program against them where they
# were unpacked. Nothing is installed. SHARED: whether the libraries of this build are.
include(${CMAKE_CURRENT_LIST_DIR}/run_step.cmake)
file(REMOVE_RECURSE ${SCRATCH})
# Fast compression: what is compressed is not the question.
run_step("Making the packages" ${CPACK} --config ${BUILD}/CPackConfig.cmake -G DEB -B ${SCRATCH}/made
  -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip)

# unpack(<package>): its fields in fields_PACKAGE, its files in files_PACKAGE, both packages in one root.
function(unpack package)
  file(GLOB deb ${SCRATCH}/made/${package}_${VERSION}-1_*.deb)
  list(LENGTH deb count)
  if(NOT count EQUAL 1)
    file(GLOB made RELATIVE ${SCRATCH}/made ${SCRATCH}/made/*.deb)
    message(FATAL_ERROR "There is no one package ${package} of version ${VERSION}-1; there are: ${made}")
  endif()
  run_step("Reading ${package}" ${DPKG_DEB} --field ${deb})
  set(fields_${package} "${step_output}" PARENT_SCOPE)
  run_step("Listing ${package}" ${DPKG_DEB} --contents ${deb})
  set(files_${package} "${step_output}" PARENT_SCOPE)
  run_step("Unpacking ${package}" ${DPKG_DEB} --extract ${deb} ${SCRATCH}/root)
endfunction()

function(must_match what text)
  foreach(expression IN LISTS ARGN)
    if(NOT text MATCHES "${expression}")
      message(FATAL_ERROR "${what} lacks ${expression}:\n${text}")
    endif()
  endforeach()
endfunction()
function(must_not_match what text)
  foreach(expression IN LISTS ARGN)
    if(text MATCHES "${expression}")
      message(FATAL_ERROR "${what} has ${expression}:\n${text}")
    endif()
  endforeach()
endfunction()

unpack(gnomon)
unpack(libgnomon-dev)
must_match("The package gnomon" "${fields_gnomon}" "Section: graphics" "Depends: [^\n]*libc6 " "libstdc\\+\\+6 "
  "Recommends: [^\n]*libvulkan1" "\nDescription: exact hard shadows[^\n]*\n gnomon draws" "\n \\.\n This package")
must_match("The files of gnomon" "${files_gnomon}" "\\./usr/bin/gnomon\n" "share/gnomon/game/levels/" "/doc/gnomon/copyright\n"
  "/doc/gnomon/changelog\\.Debian\\.gz\n")
must_not_match("The files of gnomon" "${files_gnomon}" "\\.hpp\n" "\\.a\n" "\\.cmake\n" "/doc/libgnomon-dev" " \\./usr/local")
# What is linked statically is of the development files alone; of what is shared the names that one links are.
set(only_linked "/libgnomon_shadows\\.a\n")
set(depends_on_runtime)
if(SHARED)
  set(only_linked "/libgnomon_shadows\\.so -> libgnomon_shadows\\.so\\.[0-9.]+\n")
  set(depends_on_runtime ", gnomon \\(= ${VERSION}-1\\)")
  must_match("The files of gnomon" "${files_gnomon}" "/libgnomon_shadows\\.so\\.[0-9.]+ -> " "/libgnomon_gpu\\.so\\.[0-9.]+\n")
  must_not_match("The files of libgnomon-dev" "${files_libgnomon-dev}" "\\.a\n" "\\.so\\.[0-9.]+ -> ")
endif()
must_not_match("The files of gnomon" "${files_gnomon}" "\\.so( -> [^\n]*)?\n")
must_match("The package libgnomon-dev" "${fields_libgnomon-dev}" "Section: libdevel"
  "\nDepends: libglm-dev, libexpected-dev${depends_on_runtime}\n"
  "Recommends: [^\n]*libfmt-dev" "\nDescription: exact hard shadows[^\n]*\n gnomon draws" "\n \\.\n This package has the development")
must_match("The files of libgnomon-dev" "${files_libgnomon-dev}" "include/gnomon/shadows/shadow_system\\.hpp\n"
  "${only_linked}" "/cmake/gnomon/gnomonConfig\\.cmake\n" "/pkgconfig/gnomon-shadows\\.pc\n"
  "/share/gnomon/shaders/position\\.glsl\n" "/doc/libgnomon-dev/copyright\n"
  "/doc/libgnomon-dev/changelog\\.Debian\\.gz\n")
must_not_match("The files of libgnomon-dev" "${files_libgnomon-dev}" "/bin/" "/internal/" "/gnomon/game/" "/modules/")

# The program runs where it lies, and a project finds the package there.
run_step("Running the packaged program" ${SCRATCH}/root/usr/bin/gnomon --version)
if(NOT step_output MATCHES "${VERSION}")
  message(FATAL_ERROR "gnomon --version says ${step_output}")
endif()
set(PREFIX ${SCRATCH}/root/usr)
set(CONSUMER package_shadows)
set(SCRATCH ${SCRATCH}/consumer)
include(${CMAKE_CURRENT_LIST_DIR}/build_consumer.cmake)
