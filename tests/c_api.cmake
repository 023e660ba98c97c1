# The C API, from Python and from a C program; the other tests are C++, so C is enabled here.
# With sanitizers only the buffers of callers are tested: Python and C programs cannot load a library that has them.
cotan_test(c_buffers_test SOURCES c_buffers_test.cpp c_refusals_test.cpp c_files_test.cpp c_models_test.cpp LIBRARIES cotan_c)
if(CMAKE_CXX_FLAGS MATCHES "fsanitize")
  return()
endif()
find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND)
  add_test(NAME CApi.worksFromPython
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/c_api_test.py $<TARGET_FILE:cotan_c> ${PROJECT_SOURCE_DIR}/src/c/cotan.map)
endif()
add_executable(c_facts c_facts.cpp)
target_link_libraries(c_facts PRIVATE cotan_c cotan_warnings)
add_test(NAME CApi.arrayFunctionsWork COMMAND c_facts)
enable_language(C)
add_executable(example_c ${PROJECT_SOURCE_DIR}/examples/c/main.c)
set_target_properties(example_c PROPERTIES C_STANDARD 99 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF)
target_compile_options(example_c PRIVATE -Wall -Wextra -Wpedantic -Werror)
target_link_libraries(example_c PRIVATE cotan_c m)
add_test(NAME CApi.exampleInCRuns COMMAND example_c)
# The same on Windows, under Wine.
cotan_door(CApi.worksOnWindows COMMAND ${PROJECT_SOURCE_DIR}/scripts/try-windows ${PROJECT_BINARY_DIR}/windows $<TARGET_FILE:example_c>)
