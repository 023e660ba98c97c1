# Tests integrations/blender inside Debian's Blender, which cannot load a library with sanitizers.
if(CMAKE_CXX_FLAGS MATCHES "fsanitize" OR NOT TARGET cotan_c)
  return()
endif()
find_package(Python3 COMPONENTS Interpreter)
if(NOT Python3_FOUND)
  return()
endif()
function(cotan_blender name script)
  cotan_door(Blender.${name} COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/blender/run.py ${ARGN}
    $<TARGET_FILE:cotan_c> $<TARGET_FILE:cotan> ${script})
endfunction()
cotan_blender(bakesExactNormals bake_facts.py)
cotan_blender(bakesTheFirstSurface first_facts.py)
cotan_blender(keepsAndAssignsItsMaps asset_facts.py)
cotan_blender(checksAndExports check_facts.py)
cotan_blender(errorsAreOneSentence state_facts.py)
cotan_blender(installsFromItsZip install_facts.py --installed)
cotan_blender(bakesWithoutBlockingTheWindow window_facts.py --window)
# Uses the Python that has numpy.
if(COTAN_PYTHON)
  cotan_door(Blender.tutorialReachesGodot COMMAND ${COTAN_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/blender/to_godot.py
    $<TARGET_FILE:cotan_c> $<TARGET_FILE:cotan>)
endif()
