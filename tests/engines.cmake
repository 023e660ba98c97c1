# Compiles the code that docs/how-to/engines.md tells users to paste.
if(COTAN_GLSLANG)
  cotan_test(engines_test SOURCES engines_test.cpp LIBRARIES fmt::fmt)
  target_compile_definitions(engines_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>" COTAN_GLSLANG_PATH="${COTAN_GLSLANG}")
  add_dependencies(engines_test cotan)
endif()
