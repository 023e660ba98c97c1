cotan_test(figures_test SLOW Figures.every*
  SOURCES figures_test.cpp
  LIBRARIES cotan_figures cotan_model cotan_scene cotan_inspect nlohmann_json::nlohmann_json fmt::fmt)
target_compile_definitions(figures_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
add_dependencies(figures_test cotan)
