if(TARGET cotan_cost)
  cotan_test(cost_test
    SOURCES cost_report_test.cpp cost_gpus_test.cpp cost_document_test.cpp cost_test.cpp cost_machine_code_test.cpp
    LIBRARIES cotan_lab_report cotan_cost nlohmann_json::nlohmann_json fmt::fmt)
  target_include_directories(cost_test PRIVATE ${PROJECT_SOURCE_DIR}/apps/lab/cost)
  target_compile_definitions(cost_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>" COTAN_LAB="$<TARGET_FILE:cotan_lab>")
  add_dependencies(cost_test cotan)
endif()
