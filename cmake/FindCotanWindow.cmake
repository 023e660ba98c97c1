# Finds what the window needs as one target, Cotan::Window: GLFW, Dear ImGui with its backends as Debian builds it (a
# static library), and the Vulkan loader. For Windows Dear ImGui opens the loader at run time, and needs no stb.
find_package(glfw3 QUIET)
find_package(Vulkan QUIET)
set(loader Vulkan::Vulkan)
set(stb COTAN_STB_LIBRARY)
if(WIN32)
  set(loader Vulkan::Headers)
  set(stb "")
endif()
find_path(COTAN_IMGUI_INCLUDE_DIR backends/imgui_impl_vulkan.h PATH_SUFFIXES imgui)
find_library(COTAN_IMGUI_LIBRARY imgui)
find_library(COTAN_STB_LIBRARY stb)
mark_as_advanced(COTAN_IMGUI_INCLUDE_DIR COTAN_IMGUI_LIBRARY COTAN_STB_LIBRARY)
set(CotanWindow_PARTS FALSE)
if(TARGET glfw AND TARGET ${loader})
  set(CotanWindow_PARTS TRUE)
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CotanWindow
  REQUIRED_VARS COTAN_IMGUI_LIBRARY COTAN_IMGUI_INCLUDE_DIR ${stb} CotanWindow_PARTS)
# For the desktop's file dialog, if libsystemd is available.
find_path(COTAN_BUS_INCLUDE_DIR systemd/sd-bus.h)
find_library(COTAN_BUS_LIBRARY systemd)
mark_as_advanced(COTAN_BUS_INCLUDE_DIR COTAN_BUS_LIBRARY)
if(CotanWindow_FOUND AND NOT TARGET Cotan::Window)
  add_library(Cotan::Window INTERFACE IMPORTED)
  set_target_properties(Cotan::Window PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${COTAN_IMGUI_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${COTAN_IMGUI_LIBRARY};$<$<NOT:$<BOOL:${WIN32}>>:${COTAN_STB_LIBRARY}>;glfw;${loader}"
    INTERFACE_COMPILE_DEFINITIONS "$<$<BOOL:${WIN32}>:IMGUI_IMPL_VULKAN_NO_PROTOTYPES>")
endif()
