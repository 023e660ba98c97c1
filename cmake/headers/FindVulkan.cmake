# Vulkan's headers alone: the loader is opened at run time.
include(${CMAKE_CURRENT_LIST_DIR}/header_library.cmake)
cotan_header_library(Vulkan Vulkan::Headers vulkan/vulkan.h)
if(Vulkan_FOUND)
  file(CREATE_LINK ${Vulkan_INCLUDE_DIR}/vk_video ${PROJECT_BINARY_DIR}/headers/Vulkan/vk_video SYMBOLIC)
endif()
