# Readers in a child process. sandbox_child is a reader that misbehaves.
find_package(assimp REQUIRED)
add_executable(sandbox_child sandbox_child.cpp)
target_link_libraries(sandbox_child PRIVATE cotan_model cotan_files cotan_scene fmt::fmt cotan_warnings)
cotan_test(sandbox_test SOURCES sandbox_test.cpp sandbox_wire_test.cpp sandbox_formats_test.cpp
  LIBRARIES cotan_model cotan_files cotan_scene assimp::assimp fmt::fmt)
target_include_directories(sandbox_test PRIVATE ${PROJECT_SOURCE_DIR}/src/model)
target_compile_definitions(sandbox_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>"
  SANDBOX_CHILD="$<TARGET_FILE:sandbox_child>")
add_dependencies(sandbox_test cotan sandbox_child)
