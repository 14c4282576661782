# What gnomon is built from. Everything is a Debian 12 package; nothing is downloaded. A missing optional dependency
# switches one named part off and says so.

find_package(glm REQUIRED)
find_package(tl-expected REQUIRED)

if(GNOMON_GPU OR GNOMON_SCENE)
  find_package(fmt REQUIRED)
endif()

if(GNOMON_GPU)
  find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
  find_program(SPIRV_CROSS spirv-cross REQUIRED)
endif()

if(GNOMON_GL)
  find_path(GNOMON_GL_INCLUDE_DIR GL/glcorearb.h)
  if(NOT GNOMON_GL_INCLUDE_DIR)
    message(STATUS "gnomon::gl is left out: GL/glcorearb.h was not found (package libgl-dev)")
    set(GNOMON_GL OFF)
  endif()
endif()

if(GNOMON_VK)
  find_path(GNOMON_VULKAN_INCLUDE_DIR vulkan/vulkan.h)
  if(NOT GNOMON_VULKAN_INCLUDE_DIR)
    message(STATUS "gnomon::vk is left out: vulkan/vulkan.h was not found (package libvulkan-dev)")
    set(GNOMON_VK OFF)
  endif()
endif()

if(GNOMON_GL OR GNOMON_VK)
  find_package(glfw3 QUIET)
  if(NOT glfw3_FOUND)
    message(STATUS "Windows are left out: GLFW was not found (package libglfw3-dev)")
  endif()
endif()

if(GNOMON_SCENE)
  find_package(TinyGLTF REQUIRED)
  find_package(nlohmann_json REQUIRED)
endif()

if(GNOMON_TRUTH)
  find_package(embree 3 QUIET)
  if(NOT embree_FOUND)
    message(STATUS "gnomon::truth is left out: Embree 3 was not found (package libembree-dev)")
    set(GNOMON_TRUTH OFF)
  endif()
endif()

if(GNOMON_APPS)
  find_package(CLI11 REQUIRED)
  find_package(nlohmann_json REQUIRED)
  find_path(GNOMON_STB_INCLUDE_DIR stb/stb_image_write.h REQUIRED)
endif()
