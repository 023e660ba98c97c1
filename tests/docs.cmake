# The documents against the tool, the sources and the measured tables.
cotan_test(docs_test
  SOURCES docs_test.cpp
  LIBRARIES fmt::fmt)
target_compile_definitions(docs_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
add_dependencies(docs_test cotan)
