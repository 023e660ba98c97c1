# Debian packages by CPack: scripts/deb-packages makes them in a release build. docs/project/packages.md lists their
# contents. Every install() belongs to the package that its COMPONENT names, or to libcotan-dev if it names none
# (CMakeLists.txt).
find_program(COTAN_DPKG_SHLIBDEPS dpkg-shlibdeps)
if(NOT COTAN_DPKG_SHLIBDEPS OR CMAKE_CROSSCOMPILING OR BUILD_SHARED_LIBS OR NOT TARGET cotan)
  return()
endif()
set(packaging ${PROJECT_SOURCE_DIR}/cmake/packages)
set(made ${PROJECT_BINARY_DIR}/packaging)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME cotan)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "${COTAN_MAINTAINER}")
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "${COTAN_REPOSITORY}")
foreach(file changelog copyright)
  configure_file(${packaging}/${file}.in ${made}/${file} @ONLY)
endforeach()
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
  WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(version "${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")
set(CPACK_PRE_BUILD_SCRIPTS ${packaging}/finish.cmake)

# cotan_package(NAME SECTION SUMMARY DESCRIPTION): packs a component as a package with its copyright and changelog.
function(cotan_package name section summary description)
  string(TOUPPER ${name} upper)
  list(APPEND CPACK_COMPONENTS_ALL ${name})
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${description}" PARENT_SCOPE)
  install(FILES ${made}/copyright DESTINATION share/doc/${name} COMPONENT ${name} EXCLUDE_FROM_ALL)
  install(FILES ${made}/changelog DESTINATION share/doc/${name} RENAME changelog.Debian COMPONENT ${name} EXCLUDE_FROM_ALL)
endfunction()
set(about "Cotan is normal mapping without precomputed tangents: the frame is derived
where it is needed, from screen derivatives of position and texture
coordinates, and what that costs is measured in degrees.
.")
cotan_package(cotan graphics "tool for normal mapping without precomputed tangents"
"${about}
The tool renders models, compares frames, bakes and converts normal maps,
says what is wrong with a model, prints shaders, and has a window to look at
all that. The window needs the recommended packages; pictures in OpenEXR,
TIFF and further formats need OpenImageIO, which is suggested.")
cotan_package(libcotan0 libs "normal mapping without precomputed tangents: C library"
"${about}
This is the shared library of the C interface, which other languages use, too.
Pictures in OpenEXR, TIFF and further formats need the package cotan.")
set(CPACK_DEBIAN_LIBCOTAN0_PACKAGE_SUGGESTS "cotan (= ${version})")
cotan_package(libcotan-dev libdevel "normal mapping without precomputed tangents: development files"
"${about}
These are the headers of C and C++, the parts of the C++ library as static
libraries, what CMake and pkg-config ask, and the portable text for shaders.
A part needs the development files of what it is made with; those are
suggested.")
set(CPACK_DEBIAN_LIBCOTAN-DEV_PACKAGE_DEPENDS "libcotan0 (= ${version}), libglm-dev")
set(CPACK_DEBIAN_LIBCOTAN-DEV_PACKAGE_SUGGESTS "cotan (= ${version}), cmake, pkg-config, libassimp-dev, libastcenc-dev, libdraco-dev, libembree-dev, libfmt-dev, \
libjpeg-dev, libmeshoptimizer-dev, libpng-dev, libvulkan-dev, libwebp-dev, libxxhash-dev, libzstd-dev, zlib1g-dev")
cotan_package(python3-cotan python "normal mapping without precomputed tangents: Python 3"
"${about}
This is the package for Python: bake, lint, convert and render with arrays
of numpy.")
set(CPACK_DEBIAN_PYTHON3-COTAN_PACKAGE_DEPENDS "libcotan0 (>= ${PROJECT_VERSION}), python3:any, python3-numpy")
set(CPACK_DEBIAN_PYTHON3-COTAN_PACKAGE_SUGGESTS "cotan (= ${version}), python3-distributed")
set(CPACK_DEBIAN_PYTHON3-COTAN_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON3-COTAN_PACKAGE_CONTROL_EXTRA "${packaging}/python/postinst;${packaging}/python/prerm")

install(FILES CHANGELOG.md DESTINATION share/doc/cotan RENAME changelog COMPONENT cotan EXCLUDE_FROM_ALL)
install(DIRECTORY bindings/python/cotan DESTINATION lib/python3/dist-packages COMPONENT python3-cotan EXCLUDE_FROM_ALL
  FILES_MATCHING PATTERN "*.py" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
# Metadata by which pip and importlib.metadata find the package.
file(CONFIGURE OUTPUT ${made}/METADATA CONTENT "Metadata-Version: 2.1\nName: cotan\nVersion: @PROJECT_VERSION@\n@COTAN_PROJECT_URL_LINE@" @ONLY)
install(FILES ${made}/METADATA DESTINATION lib/python3/dist-packages/cotan-${PROJECT_VERSION}.dist-info
  COMPONENT python3-cotan EXCLUDE_FROM_ALL)

# Dependencies on libcotan0 for other packages: its symbols, and the version that added each block of them.
set(COTAN_1_since 0.2.0)
set(COTAN_2_since 0.2.0)
set(COTAN_3_since 0.2.0)
set(COTAN_5_since 0.2.0)
set(COTAN_6_since 0.2.0)
set(COTAN_7_since 0.2.0)
set(COTAN_9_since 0.2.0)
file(CONFIGURE OUTPUT ${made}/shlibs CONTENT "libcotan @PROJECT_VERSION_MAJOR@ libcotan0 (>= @PROJECT_VERSION@)\n" @ONLY)
file(CONFIGURE OUTPUT ${made}/triggers CONTENT "activate-noawait ldconfig\n" @ONLY)
file(READ src/c/cotan.map script)
string(REGEX MATCHALL "COTAN_[0-9]+ {|cotan_[a-z0-9_]+" names "${script}")
set(symbols "libcotan.so.${PROJECT_VERSION_MAJOR} libcotan0 #MINVER#\n")
foreach(name ${names})
  if(name MATCHES "^(.*) {$")
    set(block ${CMAKE_MATCH_1})
    set(name ${block})
    if(NOT DEFINED ${block}_since)
      message(FATAL_ERROR "src/c/cotan.map has ${block}: "
        "add the version that introduced it to cmake/CotanPackages.cmake")
    endif()
  endif()
  string(APPEND symbols " ${name}@${block} ${${block}_since}\n")
endforeach()
file(GENERATE OUTPUT ${made}/symbols CONTENT "${symbols}")
set(CPACK_DEBIAN_LIBCOTAN0_PACKAGE_CONTROL_EXTRA "${made}/shlibs;${made}/symbols;${made}/triggers")

include(CPack)
