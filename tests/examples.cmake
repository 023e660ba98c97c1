# Runs the integration examples as they are shipped.
cotan_test(examples_test FIXTURE npm SLOW Meshes/ExampleDeforming.*large* ExampleDeformingArguments.* ExampleDeformingFigure.* ExampleWebGl2.* ExampleBabylon.* ExampleTriangleWeb.*
  SOURCES examples_browser_test.cpp browser_pages.cpp examples_triangle_web_test.cpp
  LIBRARIES cotan_model cotan_scene cotan_gltf_json)
target_compile_definitions(examples_test PRIVATE
  COTAN_TOOL="$<TARGET_FILE:cotan>" COTAN_NPM="${PROJECT_BINARY_DIR}/npm")
add_dependencies(examples_test cotan)

# The package for three.js, and repairs for other web engines.
cotan_test(web_engines_test FIXTURE npm SLOW "*"
  SOURCES three_package_test.cpp repairs_test.cpp browser_pages.cpp
  LIBRARIES cotan_model cotan_scene nlohmann_json::nlohmann_json)
target_compile_definitions(web_engines_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>" COTAN_NPM="${PROJECT_BINARY_DIR}/npm")
add_dependencies(web_engines_test cotan)

# Compares renders of real models with those of three.js.
cotan_test(three_comparison_test FIXTURE npm SLOW ThreeComparison.*
  SOURCES three_comparison_test.cpp browser_pages.cpp flip.cpp flip_test.cpp
  LIBRARIES cotan_model cotan_render cotan_scene cotan_bake cotan_inspect nlohmann_json::nlohmann_json)
target_compile_definitions(three_comparison_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>" COTAN_NPM="${PROJECT_BINARY_DIR}/npm"
  COTAN_PAIRS="${CMAKE_CURRENT_BINARY_DIR}/three_comparison")

# Compares predictions of lint with three.js.
cotan_test(three_judge_test FIXTURE npm SLOW "*"
  SOURCES three_judge_test.cpp browser_pages.cpp
  LIBRARIES cotan_model cotan_render cotan_bake cotan_inspect nlohmann_json::nlohmann_json fmt::fmt)
target_compile_definitions(three_judge_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>" COTAN_NPM="${PROJECT_BINARY_DIR}/npm")

# The recipes of docs/how-to/sparkle.md.
cotan_test(recipes_test FIXTURE npm SLOW "*"
  SOURCES recipes_test.cpp browser_pages.cpp godot_draw.cpp
  LIBRARIES cotan_scene cotan_core nlohmann_json::nlohmann_json)
target_compile_definitions(recipes_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>" COTAN_NPM="${PROJECT_BINARY_DIR}/npm")
add_dependencies(recipes_test cotan)

# The examples, built as by their own CMakeLists.txt but within this build.
target_sources(examples_test PRIVATE examples_sheets_test.cpp examples_triangle_test.cpp examples_deforming_test.cpp)
add_executable(example_raytracing ${PROJECT_SOURCE_DIR}/examples/raytracing/main.cpp)
target_compile_features(example_raytracing PRIVATE cxx_std_17)
target_link_libraries(example_raytracing PRIVATE embree cotan_warnings)
target_compile_definitions(examples_test PRIVATE COTAN_RAYTRACING="$<TARGET_FILE:example_raytracing>")
add_dependencies(examples_test example_raytracing)
if(TARGET Vulkan::Vulkan AND COTAN_GLSLANG)
  set(GLSLANG ${COTAN_GLSLANG})
  add_subdirectory(${PROJECT_SOURCE_DIR}/examples/vulkan ${CMAKE_CURRENT_BINARY_DIR}/examples_vulkan)
  target_link_libraries(vulkan_example PRIVATE cotan_warnings)
  target_compile_options(vulkan_example PRIVATE -Wno-missing-field-initializers) # they are zero
  target_compile_definitions(examples_test PRIVATE COTAN_VULKAN_EXAMPLE="$<TARGET_FILE:vulkan_example>")
  add_dependencies(examples_test vulkan_example)
  add_subdirectory(${PROJECT_SOURCE_DIR}/examples/triangle ${CMAKE_CURRENT_BINARY_DIR}/examples_triangle)
  target_link_libraries(triangle_example PRIVATE cotan_warnings)
  target_compile_definitions(examples_test PRIVATE COTAN_TRIANGLE_EXAMPLE="$<TARGET_FILE:triangle_example>")
  add_dependencies(examples_test triangle_example)
  add_subdirectory(${PROJECT_SOURCE_DIR}/examples/deforming ${CMAKE_CURRENT_BINARY_DIR}/examples_deforming)
  target_link_libraries(deforming_passes PRIVATE cotan_warnings)
  target_link_libraries(deforming_example PRIVATE cotan_warnings)
  target_compile_definitions(examples_test PRIVATE COTAN_DEFORMING_EXAMPLE="$<TARGET_FILE:deforming_example>")
  add_dependencies(examples_test deforming_example)
  if(TARGET cotan_cost)
    add_subdirectory(${PROJECT_SOURCE_DIR}/bench/gpu ${CMAKE_CURRENT_BINARY_DIR}/on_gpu)
    cotan_test(on_gpu_test SLOW "*" SOURCES on_gpu_test.cpp LIBRARIES on_gpu_page)
    target_compile_definitions(on_gpu_test PRIVATE COTAN_ON_GPU="$<TARGET_FILE:on_gpu>"
      COTAN_TOOL="$<TARGET_FILE:cotan>")
    add_dependencies(on_gpu_test on_gpu)
  endif()
endif()
