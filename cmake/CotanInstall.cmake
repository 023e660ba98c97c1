# Rules for cmake --install: every part as a component with its public headers, the portable text, and the tool.
#   find_package(cotan COMPONENTS maps bake)    gives cotan::maps and cotan::bake
# and finds their dependencies and nothing else. Without COMPONENTS: core.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# cotan-PART.pc files contain the same information for pkg-config.

# For each linked target: its package, for find_dependency, and its name for pkg-config or its linker flag.
set(COTAN_PACKAGE_glm::glm "glm")
set(COTAN_PACKAGE_Threads::Threads "Threads")
set(COTAN_PACKAGE_fmt::fmt "fmt")
set(COTAN_PACKAGE_PNG::PNG "PNG")
set(COTAN_PACKAGE_JPEG::JPEG "JPEG")
set(COTAN_PACKAGE_Astcenc::astcenc "Astcenc")
set(COTAN_PACKAGE_WebP::webp "WebP")
set(COTAN_PACKAGE_XxHash::xxhash "XxHash")
set(COTAN_PACKAGE_zstd::libzstd_shared "zstd CONFIG")
set(COTAN_PACKAGE_ZLIB::ZLIB "ZLIB")
set(COTAN_PACKAGE_OpenImageIO::OpenImageIO "OpenImageIO")
set(COTAN_PACKAGE_assimp::assimp "assimp")
set(COTAN_PACKAGE_draco::draco "draco CONFIG")
set(COTAN_PACKAGE_meshoptimizer::meshoptimizer "meshoptimizer CONFIG")
set(COTAN_PACKAGE_embree "embree ${COTAN_EMBREE_MAJOR} CONFIG")
set(COTAN_PACKAGE_Vulkan::Headers "Vulkan")
set(COTAN_PC_fmt::fmt "fmt")
set(COTAN_PC_PNG::PNG "libpng")
set(COTAN_PC_JPEG::JPEG "libjpeg")
set(COTAN_PC_WebP::webp "libwebp" "libwebpmux")
set(COTAN_PC_XxHash::xxhash "libxxhash")
set(COTAN_PC_zstd::libzstd_shared "libzstd")
set(COTAN_PC_ZLIB::ZLIB "zlib")
set(COTAN_PC_OpenImageIO::OpenImageIO "OpenImageIO")
set(COTAN_PC_assimp::assimp "assimp")
set(COTAN_PC_draco::draco "draco")
set(COTAN_FLAG_Threads::Threads "-pthread")
set(COTAN_FLAG_Astcenc::astcenc "-lastcenc")
set(COTAN_FLAG_embree "-lembree${COTAN_EMBREE_MAJOR}")
set(COTAN_FLAG_meshoptimizer::meshoptimizer "-lmeshoptimizer")

file(RELATIVE_PATH up ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
get_property(components GLOBAL PROPERTY COTAN_COMPONENTS)
set(COTAN_COMPONENT_TABLE "")
foreach(name ${components})
  get_property(links GLOBAL PROPERTY COTAN_LINKS_${name})
  set(parts "")
  set(packages "")
  set(pc_requires "")
  set(flags "")
  foreach(link ${links})
    if(link MATCHES "^cotan_(.+)$")
      list(APPEND parts ${CMAKE_MATCH_1})
      list(APPEND pc_requires cotan-${CMAKE_MATCH_1})
    elseif(DEFINED COTAN_PACKAGE_${link})
      list(APPEND packages "${COTAN_PACKAGE_${link}}")
      if(DEFINED COTAN_PC_${link})
        list(APPEND pc_requires ${COTAN_PC_${link}})
      endif()
      string(APPEND flags " ${COTAN_FLAG_${link}}")
    elseif(NOT link STREQUAL "${CMAKE_DL_LIBS}")
      message(FATAL_ERROR "cotan_${name} links ${link}: add its package to cmake/CotanInstall.cmake")
    endif()
  endforeach()
  list(REMOVE_ITEM pc_requires cotan-portable)
  string(APPEND COTAN_COMPONENT_TABLE "set(cotan_parts_${name} \"${parts}\")\n")
  string(REPLACE ";" "\" \"" quoted "${packages}")
  string(APPEND COTAN_COMPONENT_TABLE "set(cotan_packages_${name} \"${quoted}\")\n")

  set(target cotan_${name})
  install(TARGETS ${target} EXPORT cotanTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libcotan0 NAMELINK_COMPONENT libcotan-dev)
  if(NOT name STREQUAL "portable")
    get_target_property(type ${target} TYPE)
    set(library "")
    if(NOT type STREQUAL "INTERFACE_LIBRARY")
      get_target_property(file_name ${target} OUTPUT_NAME)
      if(NOT file_name)
        set(file_name ${target})
      endif()
      set(library "-l${file_name}")
    endif()
    set(definitions "")
    if(name STREQUAL "core")
      set(definitions " -I\${prefix}/share/cotan/shaders -std=c++20")
    endif()
    get_target_property(defined ${target} INTERFACE_COMPILE_DEFINITIONS)
    foreach(definition ${defined})
      if(definition)
        string(APPEND definitions " -D${definition}")
      endif()
    endforeach()
    list(JOIN pc_requires " " pc_requires)
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/cotan-${name}.pc @ONLY CONTENT "prefix=\${pcfiledir}/@up@
libdir=\${prefix}/@CMAKE_INSTALL_LIBDIR@
Name: cotan-@name@
Description: @PROJECT_DESCRIPTION@: the part @name@
Version: @PROJECT_VERSION@
Requires: @pc_requires@
Libs: -L\${libdir} @library@@flags@
Cflags: -I\${prefix}/@CMAKE_INSTALL_INCLUDEDIR@@definitions@
")
    install(FILES ${PROJECT_BINARY_DIR}/cotan-${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  endif()
endforeach()

# What find_package reports as missing in parts that are left out or incomplete.
get_property(left_out GLOBAL PROPERTY COTAN_LEFT_OUT)
foreach(name ${components} ${left_out})
  get_property(misses GLOBAL PROPERTY COTAN_MISSES_${name})
  if(misses)
    list(JOIN misses ", " misses)
    string(APPEND COTAN_COMPONENT_TABLE "set(cotan_misses_${name} \"${misses}\")\n")
  endif()
endforeach()

install(FILES ${PROJECT_BINARY_DIR}/include/cotan/version.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cotan)
get_property(includes GLOBAL PROPERTY COTAN_INCLUDES)
install(DIRECTORY ${includes} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY shaders/cotan DESTINATION share/cotan/shaders)
install(FILES LICENSE DESTINATION share/doc/cotan COMPONENT license)
install(EXPORT cotanTargets NAMESPACE cotan:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/cotan)

list(REMOVE_ITEM components portable)
list(JOIN components " " COTAN_COMPONENT_NAMES)
configure_package_config_file(cmake/cotanConfig.cmake.in ${PROJECT_BINARY_DIR}/cotanConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/cotan)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cotanConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/cotanConfig.cmake ${PROJECT_BINARY_DIR}/cotanConfigVersion.cmake
  cmake/FindAstcenc.cmake
  cmake/FindWebP.cmake
  cmake/FindXxHash.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/cotan)
