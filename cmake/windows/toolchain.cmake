# For Debian's mingw-w64 and the presets `windows` and `windows-tool`. The Find modules in cmake/headers find
# header-only libraries in the folders of this machine. COTAN_WINDOWS_SYSTEM: the folder of the libraries that
# scripts/windows-libraries builds.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(COTAN_WINDOWS_SYSTEM "" CACHE PATH "Libraries for Windows: the folder system of scripts/windows-libraries")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES COTAN_WINDOWS_SYSTEM)
set(CMAKE_FIND_ROOT_PATH ${COTAN_WINDOWS_SYSTEM} /usr/x86_64-w64-mingw32)
if(COTAN_WINDOWS_SYSTEM) # before the system's zlib, whose first library is that of a DLL
  set(ZLIB_LIBRARY ${COTAN_WINDOWS_SYSTEM}/lib/libz.a CACHE FILEPATH "")
endif()
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR}/../headers)
# Links the compiler's own libraries statically, so that nothing has to be shipped with the result, and writes no time of
# linking, so that the same sources give the same bytes.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -Wl,--no-insert-timestamp")
set(CMAKE_SHARED_LINKER_FLAGS_INIT "-static -s -Wl,--no-insert-timestamp")
# GCC 12 falsely reports overlapping memory in std::string (its bug 105651).
set(CMAKE_CXX_FLAGS_INIT "-Wno-restrict")
set(CMAKE_CROSSCOMPILING_EMULATOR wine)
