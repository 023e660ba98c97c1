# The bytes that commands print and write, held by a table.
find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND)
  add_test(NAME OutputBytes.areThoseOfTheTable
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/output_bytes.py $<TARGET_FILE:cotan> ${CMAKE_CURRENT_SOURCE_DIR}/output_bytes.txt)
  set_tests_properties(OutputBytes.areThoseOfTheTable PROPERTIES TIMEOUT 300 SKIP_RETURN_CODE 77)
endif()
