# Compiles the code that docs/how-to/engines.md tells users to paste.
if(COTAN_GLSLANG)
  cotan_test(engines_test SOURCES engines_test.cpp LIBRARIES fmt::fmt)
  target_compile_definitions(engines_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>" COTAN_GLSLANG_PATH="${COTAN_GLSLANG}")
  add_dependencies(engines_test cotan)
endif()
# What is installed in engines, run in them: tests/engines/ENGINE.py. Skipped where the engine is not in PATH;
# scripts/try-engines gets the newest versions.
if(COTAN_PYTHON)
  foreach(engine godot)
    cotan_door(Engines.${engine} COMMAND ${COTAN_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/engines/${engine}.py $<TARGET_FILE:cotan>)
  endforeach()
endif()
