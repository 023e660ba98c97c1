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
# Exceptions use the unwinding of WebAssembly, which every browser has. The same holds for 128-bit SIMD and for bulk
# memory instructions.
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions -msimd128 -mbulk-memory -flto -DGLM_FORCE_INLINE -fno-unroll-loops -fno-slp-vectorize -include ${CMAKE_CURRENT_LIST_DIR}/libcxx_13.hpp")
