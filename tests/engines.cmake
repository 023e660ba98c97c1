# Compiles the code that docs/how-to/engines.md tells users to paste.
if(COTAN_GLSLANG)
  cotan_test(engines_test SOURCES engines_test.cpp LIBRARIES fmt::fmt)
  target_compile_definitions(engines_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>" COTAN_GLSLANG_PATH="${COTAN_GLSLANG}")
  add_dependencies(engines_test cotan)
endif()
# What users of Unity and Unreal install, and the zips of all packages for engines.
find_package(Python3 COMPONENTS Interpreter)
if(COTAN_GLSLANG AND Python3_FOUND)
  add_test(NAME Engines.packagesCompileAndNameTheirFiles COMMAND ${Python3_EXECUTABLE}
    ${CMAKE_CURRENT_SOURCE_DIR}/engine_packages_test.py ${PROJECT_SOURCE_DIR} $<TARGET_FILE:cotan> ${COTAN_GLSLANG})
  set_tests_properties(Engines.packagesCompileAndNameTheirFiles PROPERTIES TIMEOUT 300)
  # The same, and all that `cotan shader` prints, by Microsoft's compilers.
  cotan_door(Direct3D.packagesCompile COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/engine_packages_test.py
    ${PROJECT_SOURCE_DIR} $<TARGET_FILE:cotan> ${COTAN_GLSLANG} ${PROJECT_BINARY_DIR}/direct3d)
  cotan_door(Direct3D.printedTextCompilesWithoutWarnings COMMAND ${Python3_EXECUTABLE}
    ${CMAKE_CURRENT_SOURCE_DIR}/direct3d/compilers_test.py ${PROJECT_SOURCE_DIR} $<TARGET_FILE:cotan> ${PROJECT_BINARY_DIR}/direct3d)
  set_tests_properties(Direct3D.packagesCompile Direct3D.printedTextCompilesWithoutWarnings PROPERTIES TIMEOUT 1500)
endif()
# What is installed in engines, run in them: tests/engines/ENGINE.py. Skipped where the engine is not in PATH;
# scripts/try-engines gets the newest versions.
if(COTAN_PYTHON)
  foreach(engine blender godot raylib ogre qtquick3d vtk f3d filament)
    cotan_door(Engines.${engine} COMMAND ${COTAN_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/engines/${engine}.py $<TARGET_FILE:cotan>)
    set_tests_properties(Engines.${engine} PROPERTIES TIMEOUT 1500)
  endforeach()
  cotan_door(Direct3D.drawsTheRings COMMAND ${COTAN_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/engines/direct3d.py $<TARGET_FILE:cotan>
    ${PROJECT_BINARY_DIR}/direct3d)
endif()
