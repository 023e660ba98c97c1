# The C API, from Python and from a C program; the other tests are C++, so C is enabled here.
# With sanitizers only the buffers of callers are tested: Python and C programs cannot load a library that has them.
cotan_test(c_buffers_test SOURCES c_buffers_test.cpp c_refusals_test.cpp c_files_test.cpp c_models_test.cpp LIBRARIES cotan_c)
target_compile_definitions(c_buffers_test PRIVATE COTAN_NO_OLD_NAMES)
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
target_compile_definitions(c_facts PRIVATE COTAN_NO_OLD_NAMES)
add_test(NAME CApi.arrayFunctionsWork COMMAND c_facts)
enable_language(C)
add_executable(example_c ${PROJECT_SOURCE_DIR}/examples/c/main.c)
target_compile_definitions(example_c PRIVATE COTAN_NO_OLD_NAMES)
add_executable(c_old_names c_old_names.c)
foreach(program example_c c_old_names)
  set_target_properties(${program} PROPERTIES C_STANDARD 99 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF)
  target_compile_options(${program} PRIVATE -Wall -Wextra -Wpedantic -Werror)
  target_link_libraries(${program} PRIVATE cotan_c m)
endforeach()
add_test(NAME CApi.exampleInCRuns COMMAND example_c)
# libcotan bakes with its own Embree in a program that exports another, as Blender does. It needs none of the program's
# functions but the one that keeps the library.
get_target_property(sources cotan_c SOURCES)
if("own_embree.cpp" IN_LIST sources)
  add_library(other_embree SHARED other_embree.cpp)
  add_test(NAME CApi.bakesInAProgramThatHasAnotherEmbree COMMAND example_c)
  set_tests_properties(CApi.bakesInAProgramThatHasAnotherEmbree PROPERTIES
    ENVIRONMENT LD_PRELOAD=$<TARGET_FILE:other_embree> PASS_REGULAR_EXPRESSION "baked 204 128 230")
  add_test(NAME CApi.looksUpAllFunctionsOfEmbree COMMAND sh -c "nm -D '$<TARGET_FILE:cotan_c>' | grep ' U rtc'")
  set_tests_properties(CApi.looksUpAllFunctionsOfEmbree PROPERTIES
    PASS_REGULAR_EXPRESSION "^ *U rtcRetainDevice\n?$" FAIL_REGULAR_EXPRESSION "rtc[A-QS-Z]")
endif()
add_test(NAME CApi.sourceOfTheLastVersionCompilesAndRuns COMMAND c_old_names)
# The same on Windows, under Wine.
cotan_door(CApi.worksOnWindows COMMAND ${PROJECT_SOURCE_DIR}/scripts/try-windows ${PROJECT_BINARY_DIR}/windows $<TARGET_FILE:example_c>)
