if(TARGET cotan_vulkan)
  cotan_test(render_test SLOW RenderValidation.*
    SOURCES render_test.cpp render_frame_test.cpp render_shading_test.cpp render_mips_test.cpp
      render_layers_test.cpp render_layout_test.cpp render_shared_device_test.cpp render_view_data_test.cpp
    LIBRARIES cotan_render)
  # Internals are tested: mip chains, and the layout of GPU structs in the compiled shaders.
  target_include_directories(render_test PRIVATE ${PROJECT_SOURCE_DIR}/src/render/vulkan
    $<TARGET_PROPERTY:cotan_vulkan,BINARY_DIR>)
  add_dependencies(render_test cotan_vulkan)
endif()
