# Batches of command lines. batch_child is a job that misbehaves.
add_executable(batch_child batch_child.cpp)
target_link_libraries(batch_child PRIVATE cotan_batch cotan_files cotan_warnings)
cotan_test(batch_test SLOW BatchPage.onlyVisibleRows* SOURCES batch_jobs_test.cpp batch_run_test.cpp batch_process_test.cpp batch_report_test.cpp
    batch_store_test.cpp batch_thumbnail_test.cpp
  LIBRARIES cotan_batch cotan_image cotan_files nlohmann_json::nlohmann_json fmt::fmt)
target_compile_definitions(batch_test PRIVATE BATCH_CHILD="$<TARGET_FILE:batch_child>" COTAN_TOOL="$<TARGET_FILE:cotan>")
add_dependencies(batch_test batch_child cotan)
cotan_test(batch_command_test SLOW BatchCommand.anInterrupt* SOURCES batch_command_test.cpp
  LIBRARIES cotan_model cotan_scene cotan_files nlohmann_json::nlohmann_json fmt::fmt)
target_compile_definitions(batch_command_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
add_dependencies(batch_command_test cotan)
# Farms of each kind, which the tests start.
cotan_door(Farm.slurm COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/batch_slurm $<TARGET_FILE:cotan>)
cotan_door(Farm.dask COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/batch_dask.py $<TARGET_FILE:cotan>)
