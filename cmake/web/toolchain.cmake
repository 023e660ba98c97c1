# For Debian's emscripten and the preset `web`: see bindings/js. The Find modules in cmake/headers find header-only
# libraries in the folders of this machine.
find_program(COTAN_EMCC emcc REQUIRED)
file(REAL_PATH ${COTAN_EMCC} emcc)
cmake_path(GET emcc PARENT_PATH EMSCRIPTEN_ROOT_PATH)
if(NOT EXISTS ${EMSCRIPTEN_ROOT_PATH}/cmake)
  set(EMSCRIPTEN_ROOT_PATH /usr/share/emscripten)
endif()
include(${EMSCRIPTEN_ROOT_PATH}/cmake/Modules/Platform/Emscripten.cmake)
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR}/../headers)
# Exceptions and setjmp use the unwinding of WebAssembly, which every browser and Node.js 18 have. The same holds for
# 128-bit SIMD and for bulk memory instructions.
set(flags "-fwasm-exceptions -msimd128 -mbulk-memory")
set(CMAKE_CXX_FLAGS_INIT "-DGLM_FORCE_INLINE -include ${CMAKE_CURRENT_LIST_DIR}/libcxx_13.hpp")
# The preset `web` makes small modules, with Zstandard if there is a folder of libraries. `web-tool` makes the tool, with
# all of them.
set(COTAN_WEB_SYSTEM "" CACHE PATH "Libraries for WebAssembly: the folder system of scripts/web-libraries")
option(COTAN_WEB_TOOL "The tool and its libraries, not modules for pages" OFF)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES COTAN_WEB_SYSTEM COTAN_WEB_TOOL)
if(COTAN_WEB_SYSTEM)
  list(APPEND CMAKE_FIND_ROOT_PATH ${COTAN_WEB_SYSTEM})
endif()
if(COTAN_WEB_TOOL)
  set(CMAKE_EXE_LINKER_FLAGS_INIT -O1) # higher levels need a package of Node.js to make the JavaScript smaller
  set(CMAKE_C_FLAGS_INIT "${flags} -sSUPPORT_LONGJMP=wasm")
  string(PREPEND CMAKE_CXX_FLAGS_INIT "${flags} -sSUPPORT_LONGJMP=wasm -DCOTAN_NPM_TOOL -include ${CMAKE_CURRENT_LIST_DIR}/real_numbers.hpp ")
else()
  string(PREPEND CMAKE_CXX_FLAGS_INIT "${flags} -flto -fno-unroll-loops -fno-slp-vectorize ")
endif()
