# Compares the bytes that commands print and write with tables. Checks that each option changes them, that both
# renderers draw the same, that a fault leaves no partial output, and that no option overwrites an input.
find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND)
  foreach(table lab maps meshes pictures shader_text)
    add_test(NAME OutputBytes.${table}
      COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/output_bytes.py $<TARGET_FILE:cotan> ${CMAKE_CURRENT_SOURCE_DIR}/output_bytes/${table}.txt)
    set_tests_properties(OutputBytes.${table} PROPERTIES TIMEOUT 300 SKIP_RETURN_CODE 77)
    cotan_slow(OutputBytes.${table})
  endforeach()
  add_test(NAME TwoRenderers.drawTheSame
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/two_renderers_test.py $<TARGET_FILE:cotan> ${CMAKE_CURRENT_SOURCE_DIR}/output_bytes/pictures.txt)
  set_tests_properties(TwoRenderers.drawTheSame PROPERTIES TIMEOUT 900 SKIP_RETURN_CODE 77 COST 75)
  cotan_slow(TwoRenderers.drawTheSame)
  if(NOT CMAKE_CXX_FLAGS MATCHES "fsanitize") # the sanitizers' library must be loaded first
    add_test(NAME FailingCalls.leaveCompleteOutputOrNone
      COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/failing_calls_test.py $<TARGET_FILE:cotan>)
    set_tests_properties(FailingCalls.leaveCompleteOutputOrNone PROPERTIES TIMEOUT 900 SKIP_RETURN_CODE 77 COST 120 PROCESSORS 2)
    cotan_slow(FailingCalls.leaveCompleteOutputOrNone)
  endif()
  foreach(command render compare bake convert map others)
    add_test(NAME OptionEffects.${command}
      COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/option_effects_test.py $<TARGET_FILE:cotan> ${command})
    set_tests_properties(OptionEffects.${command} PROPERTIES TIMEOUT 300 SKIP_RETURN_CODE 77)
    cotan_slow(OptionEffects.${command})
  endforeach()
  foreach(command look map make others)
    add_test(NAME OverwriteWalk.${command}
      COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/overwrite_walk_test.py $<TARGET_FILE:cotan> ${command})
    set_tests_properties(OverwriteWalk.${command} PROPERTIES TIMEOUT 300)
    cotan_slow(OverwriteWalk.${command})
  endforeach()
endif()
