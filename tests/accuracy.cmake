# The tables of `cotan accuracy`, their files, and the committed figures.
cotan_test(accuracy_test
  SOURCES accuracy_bars_test.cpp accuracy_figures_test.cpp accuracy_same_test.cpp accuracy_command_test.cpp theory_test.cpp
    truth_surface_test.cpp
  LIBRARIES cotan_report cotan_truth cotan_core fmt::fmt)
target_compile_definitions(accuracy_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
add_dependencies(accuracy_test cotan)
