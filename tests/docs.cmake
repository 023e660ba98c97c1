# Compares the documents with the tool, the sources and the measured tables.
cotan_test(docs_test SLOW PageCommands.* Tutorials.* DocumentsOfModels.*
  SOURCES docs_test.cpp docs_models_test.cpp tutorials_test.cpp version_test.cpp
  LIBRARIES fmt::fmt nlohmann_json::nlohmann_json)
target_compile_definitions(docs_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>" COTAN_VERSION="${PROJECT_VERSION}")
add_dependencies(docs_test cotan)
# The page of the command line must be the tool's own help.
find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND)
  add_test(NAME Documents.commandLinePageMatchesTheTool COMMAND ${Python3_EXECUTABLE}
    ${PROJECT_SOURCE_DIR}/docs/reference/make-command-line $<TARGET_FILE:cotan> ${PROJECT_BINARY_DIR}/share --check)
  add_test(NAME Documents.libraryPagesMatchTheHeaders COMMAND ${Python3_EXECUTABLE}
    ${PROJECT_SOURCE_DIR}/docs/reference/make-api --check)
  add_test(NAME Documents.architectureDrawingIsCurrent COMMAND ${Python3_EXECUTABLE}
    ${PROJECT_SOURCE_DIR}/docs/project/make-architecture --check)
endif()
# The line limit of .clang-format, for C, C++ and shaders. Needs git, which lists the files.
if(Python3_FOUND AND EXISTS ${PROJECT_SOURCE_DIR}/.git)
  add_test(NAME Format.noLineIsOverTheLimit COMMAND ${PROJECT_SOURCE_DIR}/scripts/format --long-lines)
endif()
if(Python3_FOUND)
  add_test(NAME Format.constantNamesAreUniqueInEachPart COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/constants.py ${PROJECT_SOURCE_DIR})
  add_test(NAME Mutants.linesFollowMovedCode COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/mutation/repair_test.py)
  add_test(NAME Changelog.collectsUnreleasedChanges COMMAND ${PROJECT_SOURCE_DIR}/scripts/changelog)
  add_test(NAME PageSnippets.compileWithThePrintedText COMMAND ${Python3_EXECUTABLE}
    ${CMAKE_CURRENT_SOURCE_DIR}/page_snippets_test.py $<TARGET_FILE:cotan> ${PROJECT_SOURCE_DIR}/docs/how-to/beyond.md)
  set_tests_properties(PageSnippets.compileWithThePrintedText PROPERTIES SKIP_RETURN_CODE 77)
  add_test(NAME Mutants.everyMistakeMatchesTheSource COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/mutants --check)
endif()
