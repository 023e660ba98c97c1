# Libraries that Cotan is built with where they are there. COTAN_WITH_NAME: AUTO looks for it, ON insists on it, OFF leaves
# it alone. COTAN_WITH is what all of them are that are not set themselves:
#   cmake -DCOTAN_WITH=OFF                          the smallest house: a compiler and GLM
#   cmake -DCOTAN_WITH=OFF -DCOTAN_WITH_VULKAN=ON   with the Vulkan renderer, to be carried to a machine that has little else
set(COTAN_WITH AUTO CACHE STRING "What a COTAN_WITH_... is that is empty: AUTO, ON or OFF")

# cotan_optional(NAME TARGET WORD PACKAGES COST ARGUMENTS...): find_package(ARGUMENTS...), which makes TARGET. WORD: its
# name for people. PACKAGES: what to install on Debian. COST: what is missing without it.
function(cotan_optional name target word packages cost)
  set(COTAN_WITH_${name} "" CACHE STRING "${word}: AUTO, ON or OFF; empty: as COTAN_WITH")
  set(wanted "${COTAN_WITH_${name}}")
  if(wanted STREQUAL "")
    set(wanted "${COTAN_WITH}")
  endif()
  string(TOUPPER "${wanted}" wanted)
  set(reason "")
  if(wanted STREQUAL "AUTO")
    find_package(${ARGN} QUIET)
    if(NOT TARGET ${target})
      set(reason "not found: install ${packages}")
    endif()
  elseif(wanted)
    find_package(${ARGN} REQUIRED)
  else()
    set(reason "COTAN_WITH_${name} is OFF")
  endif()
  set_property(GLOBAL APPEND PROPERTY COTAN_OPTIONAL ${target})
  set_property(GLOBAL PROPERTY COTAN_WORD_${target} "${word}")
  set_property(GLOBAL PROPERTY COTAN_REASON_${target} "${reason}")
  set_property(GLOBAL PROPERTY COTAN_COST_${target} "${cost}")
endfunction()

cotan_optional(TBB TBB::tbb oneTBB libtbb-dev "baking, converting, maps and the reference renderer use one core" TBB)
cotan_optional(FMT fmt::fmt "{fmt}" libfmt-dev "no files, no tool: the parts without text remain" fmt)
cotan_optional(JSON nlohmann_json::nlohmann_json nlohmann-json nlohmann-json3-dev "no glTF, no tool" nlohmann_json)
cotan_optional(CLI11 CLI11::CLI11 CLI11 libcli11-dev "no tool" CLI11)
cotan_optional(PNG PNG::PNG libpng libpng-dev "no PNG files, no tool" PNG)
cotan_optional(JPEG JPEG::JPEG libjpeg libjpeg-dev "no JPEG files, no tool" JPEG)
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
cotan_optional(WEBP WebP::webp libwebp libwebp-dev "no WebP files, nor glTF with such pictures" WebP)
cotan_optional(ZSTD zstd::libzstd_shared libzstd libzstd-dev "no KTX2 files packed with Zstandard" zstd CONFIG)
cotan_optional(ZLIB ZLIB::ZLIB zlib zlib1g-dev "no KTX2 files packed with zlib" ZLIB)
cotan_optional(OPENIMAGEIO OpenImageIO::OpenImageIO OpenImageIO "libopenimageio-dev openimageio-tools"
  "no EXR, TIFF, HDR, TGA, BMP, DDS and blocks in KTX2; JPEG is read and not written" OpenImageIO)
cotan_optional(ASSIMP assimp::assimp Assimp libassimp-dev "of models only glTF and OBJ" assimp)
cotan_optional(DRACO draco::draco Draco libdraco-dev "no glTF compressed with Draco" draco CONFIG)
cotan_optional(MESHOPTIMIZER meshoptimizer::meshoptimizer meshoptimizer libmeshoptimizer-dev
  "no glTF compressed with meshoptimizer" meshoptimizer CONFIG)
cotan_optional(XXHASH XxHash::xxhash xxHash libxxhash-dev "no cotan batch" XxHash)
cotan_optional(EMBREE embree "Embree 3" libembree-dev "no baking" embree 3 CONFIG)
cotan_optional(VULKAN Vulkan::Headers Vulkan "libvulkan-dev glslang-tools"
  "pictures are drawn on the processor, no cotan cost" Vulkan)
cotan_optional(WINDOW Cotan::Window "GLFW and Dear ImGui" "libglfw3-dev and libimgui-dev" "no cotan view" CotanWindow)
find_program(COTAN_GLSLANG glslangValidator)
