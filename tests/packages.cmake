# Debian packages of this build, which is not optimised: their contents, lintian's verdict, and programs that are built
# and run with nothing else. scripts/try-deb installs the packages of a release build into a bare Debian.
if(NOT CMAKE_CXX_FLAGS MATCHES "fsanitize")
  cotan_door(Packages.areCompleteAndProvideToolLibraryAndPython
    COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/packages_test.sh ${PROJECT_BINARY_DIR})
endif()
