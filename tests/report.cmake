cotan_test(report_test
  SOURCES report_test.cpp report_convert_test.cpp report_lines_test.cpp
  LIBRARIES cotan_report cotan_shapes nlohmann_json::nlohmann_json)
