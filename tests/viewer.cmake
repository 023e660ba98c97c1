# The viewer's behaviour without a window, and the window on a display in memory.
if(TARGET cotan_viewer)
  cotan_test(viewer_test SLOW ViewerMenus.*
    SOURCES viewer_bake_test.cpp viewer_camera_test.cpp viewer_camera_moves_test.cpp viewer_commands_test.cpp viewer_menus_test.cpp viewer_state_test.cpp
      pick_test.cpp inspection_test.cpp drawn_edges_test.cpp
      inspection_views_test.cpp viewer_input_test.cpp viewer_interface_test.cpp viewer_orders_test.cpp viewer_pictures_test.cpp viewer_report_test.cpp
      viewer_requests_test.cpp viewer_tasks_test.cpp
    LIBRARIES cotan_viewer cotan_maps cotan_inspect cotan_scene fmt::fmt)
  target_compile_definitions(viewer_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
  add_dependencies(viewer_test cotan)
  if(TARGET cotan_window)
    cotan_test(view_window_test SLOW ViewWindow.reloads* ViewWindow.aChangedEnvironment* ViewWindow.showsExactly*
      ViewWindow.thePrinted* ViewWindow.dragsAndKeys* ViewWindow.theReportSays* ViewWindow.recordedSessions* ViewPanels.each* ViewBake.theDivider*
      SOURCES view_animation_test.cpp view_bake_test.cpp view_display_test.cpp view_files_test.cpp view_panels_test.cpp view_random_test.cpp view_window_test.cpp
      LIBRARIES cotan_model cotan_image cotan_scene fmt::fmt)
    if(COTAN_BUS_LIBRARY AND COTAN_BUS_INCLUDE_DIR)
      target_sources(view_window_test PRIVATE view_portal_test.cpp)
      target_link_libraries(view_window_test PRIVATE ${COTAN_BUS_LIBRARY})
    endif()
    target_compile_definitions(view_window_test PRIVATE COTAN_TOOL="$<TARGET_FILE:cotan>")
    add_dependencies(view_window_test cotan)
  endif()
endif()
