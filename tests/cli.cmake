# The tool itself, run as a user would run it.
cotan_test(cli_test
  SOURCES cli_test.cpp cli_bad_input_test.cpp cli_packed_input_test.cpp capital_endings_test.cpp own_maps_test.cpp
    render_turntable_test.cpp command_words_test.cpp
  LIBRARIES cotan_model cotan_scene cotan_inspect nlohmann_json::nlohmann_json fmt::fmt)
target_compile_definitions(cli_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
add_dependencies(cli_test cotan)
# What is read and what is written: by functions, and by every command.
cotan_test(files_test
  SOURCES app_words_test.cpp files_test.cpp files_told_test.cpp module_test.cpp overwrite_test.cpp
  LIBRARIES cotan_app cotan_files cotan_model cotan_scene nlohmann_json::nlohmann_json fmt::fmt)
add_library(module_versions MODULE module_versions.cpp)
# Not beside the tests, where it would be found whatever folder is asked for.
set_target_properties(module_versions PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/modules)
target_compile_definitions(files_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>"
  MODULE_FOLDER="$<TARGET_FILE_DIR:module_versions>" MODULE_NAME="$<TARGET_FILE_NAME:module_versions>")
add_dependencies(files_test cotan module_versions)
cotan_test(help_test
  SOURCES help_test.cpp man_page_test.cpp progress_test.cpp
  LIBRARIES cotan_app cotan_scene fmt::fmt)
target_compile_definitions(help_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
add_dependencies(help_test cotan)
# A few commands under every fault; the whole table is in docs/project/robustness.md.
add_test(NAME Faults.quick COMMAND ${PROJECT_SOURCE_DIR}/scripts/try-faults --quick $<TARGET_FILE:cotan>)
set_tests_properties(Faults.quick PROPERTIES TIMEOUT 300)
# What docs/reference/json.md says of reports, against the reports.
find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND)
  add_test(NAME JsonFields.areThoseOfThePage COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/json_fields_test.py
    $<TARGET_FILE:cotan> ${PROJECT_SOURCE_DIR}/docs/reference/json.md)
  set_tests_properties(JsonFields.areThoseOfThePage PROPERTIES TIMEOUT 300)
endif()
# Words as values, without a process.
cotan_test(words_test
  SOURCES arguments_test.cpp completion_text_test.cpp help_text_test.cpp bake_scenes_test.cpp camera_words_test.cpp picture_light_test.cpp picture_options_test.cpp turntable_test.cpp
  LIBRARIES cotan_app cotan_scene fmt::fmt)
# The manual's pages, and completion by the shells themselves.
foreach(part man words bash zsh fish)
  add_test(NAME HelpFiles.${part} COMMAND python3 ${CMAKE_CURRENT_SOURCE_DIR}/help_files_test.py $<TARGET_FILE:cotan> ${PROJECT_BINARY_DIR}/share ${part})
  set_tests_properties(HelpFiles.${part} PROPERTIES TIMEOUT 300 SKIP_RETURN_CODE 77)
endforeach()
