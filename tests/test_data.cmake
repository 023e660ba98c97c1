# Where tests find models, what scripts/test-data makes, and the file of hosted CI.
if(Python3_FOUND)
  foreach(fact one_rule_finds_all_data the_rule_is_the_same_in_javascript_and_python
      without_network_one_line_says_so_and_the_rest_is_made what_is_fetched_is_pinned_by_checksums the_data_are_complete)
    add_test(NAME TestData.${fact} COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/test_data_test.py ${fact})
    set_tests_properties(TestData.${fact} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300)
  endforeach()
  cotan_slow(TestData.without_network_one_line_says_so_and_the_rest_is_made) # makes all data
  # The first Python that has PyYAML: Debian's, if another one comes first.
  foreach(python ${Python3_EXECUTABLE} /usr/bin/python3)
    execute_process(COMMAND ${python} -c "import yaml" RESULT_VARIABLE missing OUTPUT_QUIET ERROR_QUIET)
    if(NOT missing)
      set(COTAN_YAML_PYTHON ${python})
      break()
    endif()
  endforeach()
  if(NOT COTAN_YAML_PYTHON)
    set(COTAN_YAML_PYTHON ${Python3_EXECUTABLE}) # the test says that PyYAML is missing
  endif()
  foreach(fact file_has_the_keys_of_a_workflow no_action_but_checkout_is_used every_script_exists_and_both_are_run
      systems_are_those_that_setup_supports)
    add_test(NAME HostedCi.${fact} COMMAND ${COTAN_YAML_PYTHON} -B ${CMAKE_CURRENT_SOURCE_DIR}/hosted_ci_test.py ${fact})
    set_tests_properties(HostedCi.${fact} PROPERTIES SKIP_RETURN_CODE 77)
  endforeach()
endif()
