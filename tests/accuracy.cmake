# The tables of `cotan accuracy`, their files, and the committed figures.
cotan_test(accuracy_test SLOW AccuracyFigures.* AccuracyCommand.bars* AccuracyCommand.flat*
  SOURCES accuracy_bars_test.cpp accuracy_figures_test.cpp accuracy_committed_test.cpp accuracy_command_test.cpp theory_test.cpp
    truth_surface_test.cpp
  LIBRARIES cotan_lab_report cotan_truth cotan_core fmt::fmt)
target_compile_definitions(accuracy_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
add_dependencies(accuracy_test cotan)
# The program that the tool starts for accuracy, figures and cost.
set(costs "")
if(TARGET cotan_cost)
  set(costs cotan_cost)
endif()
cotan_test(lab_test SOURCES lab_test.cpp LIBRARIES cotan_app cotan_figures cotan_truth ${costs})
foreach(fact printsTheSame missingProgramIsReported endsOnSignals)
  add_test(NAME Lab.${fact} COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/lab_test.sh $<TARGET_FILE:cotan> ${PROJECT_BINARY_DIR}/lab ${fact})
endforeach()
