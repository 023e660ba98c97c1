# The library in hosts that have chosen a locale: numbers are written with a decimal comma, and with dots between thousands,
# in German; capital I has another small letter in Turkish; the decimal point has two bytes in Pashto.
# The library that calls setlocale is loaded before the program; those of sanitizers must be loaded first.
if(CMAKE_CXX_FLAGS MATCHES "fsanitize")
  return()
endif()
add_library(locale_host SHARED locale_host.cpp)
target_link_libraries(locale_host PRIVATE cotan_warnings)
function(cotan_in_locales name locales)
  foreach(locale IN LISTS locales)
    add_test(NAME Locale.${name}.${locale} COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/in_locale ${PROJECT_BINARY_DIR}/locales ${locale}.UTF-8
      $<TARGET_FILE:locale_host> ${ARGN})
    set_tests_properties(Locale.${name}.${locale} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300)
  endforeach()
endfunction()
foreach(test c_buffers_test obj_test)
  if(TARGET ${test})
    cotan_in_locales(${test} "de_DE;tr_TR;ps_AF" $<TARGET_FILE:${test}>)
  endif()
endforeach()
if(TARGET gltf_test) # other tests in it parse JSON by themselves
  cotan_in_locales(gltf_test "de_DE;tr_TR;ps_AF" $<TARGET_FILE:gltf_test> --gtest_filter=Gltf*)
endif()
foreach(test image_test shader_text_test)
  if(TARGET ${test})
    cotan_in_locales(${test} de_DE $<TARGET_FILE:${test}>)
  endif()
endforeach()
if(TARGET viewer_test) # the others draw: they print and read no numbers
  cotan_in_locales(viewer_test de_DE $<TARGET_FILE:viewer_test>
    --gtest_filter=-ViewerMenus.*:ViewerPictures.*:ViewerFiles.*:ViewerPlayer.*)
  cotan_slow(Locale.viewer_test.de_DE)
endif()
# Programs in other languages leave the streams of C++ to the library.
foreach(locale IN ITEMS de_DE tr_TR ps_AF)
  set_property(TEST Locale.c_buffers_test.${locale} PROPERTY ENVIRONMENT COTAN_STREAMS_TOO=1)
endforeach()
cotan_in_locales(exampleInC de_DE $<TARGET_FILE:example_c>)
if(COTAN_PYTHON)
  foreach(part options models render maps)
    set(only "")
    if(part STREQUAL "options") # those with a decimal point
      set(only -k "0. or 2.5 or max_degrees")
    elseif(part STREQUAL "maps")
      set(only -k "not by_the_command_line") # two minutes, without numbers that a locale writes
    endif()
    cotan_in_locales(Python.${part} de_DE ${COTAN_PYTHON} -m pytest -q -p no:cacheprovider ${only} ${CMAKE_CURRENT_SOURCE_DIR}/python/test_${part}.py)
    cotan_slow(Locale.Python.${part}.de_DE)
    set_property(TEST Locale.Python.${part}.de_DE PROPERTY ENVIRONMENT
      "COTAN_LIBRARY=$<TARGET_FILE:cotan_c>;COTAN_TOOL=$<TARGET_FILE:cotan>"
      COTAN_STREAMS_TOO=1 "PYTHONPATH=${PROJECT_SOURCE_DIR}/bindings/python;PYTHONDONTWRITEBYTECODE=1")
  endforeach()
endif()
