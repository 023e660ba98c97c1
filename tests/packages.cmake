# Debian packages of this build, which is not optimised: what is in them, what lintian says, and what is built and run
# with nothing but them. scripts/try-deb installs those of a release build into a bare Debian.
if(NOT CMAKE_CXX_FLAGS MATCHES "fsanitize")
  cotan_door(Packages.areWholeAndServeToolLibraryAndPython
    COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/packages_test.sh ${PROJECT_BINARY_DIR})
endif()
