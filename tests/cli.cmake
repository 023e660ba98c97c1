# The tool, run as users run it.
cotan_test(cli_test SLOW CommandLine.every* FoundInput.everyCommand*
  SOURCES cli_test.cpp cli_bad_input_test.cpp cli_packed_input_test.cpp capital_extensions_test.cpp own_maps_test.cpp
    render_turntable_test.cpp command_errors_test.cpp
  LIBRARIES cotan_model cotan_scene cotan_inspect nlohmann_json::nlohmann_json fmt::fmt)
target_compile_definitions(cli_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
add_dependencies(cli_test cotan)
# Files that are read and written, by functions and by every command.
cotan_test(files_test
  SOURCES app_shared_test.cpp files_test.cpp file_errors_test.cpp module_test.cpp overwrite_test.cpp open_once_test.cpp
  LIBRARIES cotan_app cotan_files cotan_model cotan_scene nlohmann_json::nlohmann_json fmt::fmt)
add_library(module_versions MODULE module_versions.cpp)
# Outside the folder of the tests, where it would always be found.
set_target_properties(module_versions PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/modules)
target_compile_definitions(files_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>"
  MODULE_FOLDER="$<TARGET_FILE_DIR:module_versions>" MODULE_NAME="$<TARGET_FILE_NAME:module_versions>")
add_dependencies(files_test cotan module_versions)
cotan_test(help_test SLOW Help.every* ProgressLine.showsTheRemaining*
  SOURCES help_test.cpp man_page_test.cpp progress_test.cpp
  LIBRARIES cotan_app cotan_scene fmt::fmt)
target_compile_definitions(help_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
add_dependencies(help_test cotan)
# A few commands under every fault; docs/project/robustness.md has the complete table.
add_test(NAME Faults.quick COMMAND ${PROJECT_SOURCE_DIR}/scripts/try-faults --quick $<TARGET_FILE:cotan>)
set_tests_properties(Faults.quick PROPERTIES TIMEOUT 300)
cotan_slow(Faults.quick)
# Compares docs/reference/json.md with the reports.
find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND)
  add_test(NAME JsonFields.matchThePage COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/json_fields_test.py
    $<TARGET_FILE:cotan> ${PROJECT_SOURCE_DIR}/docs/reference/json.md)
  set_tests_properties(JsonFields.matchThePage PROPERTIES TIMEOUT 300)
  cotan_slow(JsonFields.matchThePage)
endif()
# Parsing of words to values, without a process.
cotan_test(words_test
  SOURCES arguments_test.cpp completion_text_test.cpp file_words_test.cpp help_text_test.cpp bake_scenes_test.cpp camera_arguments_test.cpp picture_light_test.cpp picture_options_test.cpp shell_words_test.cpp turntable_test.cpp
  LIBRARIES cotan_app cotan_scene fmt::fmt)
# Manual pages, and completion by the shells themselves.
foreach(part man words bash zsh fish)
  add_test(NAME HelpFiles.${part} COMMAND python3 ${CMAKE_CURRENT_SOURCE_DIR}/help_files_test.py $<TARGET_FILE:cotan> ${PROJECT_BINARY_DIR}/share ${part})
  set_tests_properties(HelpFiles.${part} PROPERTIES TIMEOUT 300 SKIP_RETURN_CODE 77)
  cotan_slow(HelpFiles.${part})
endforeach()
