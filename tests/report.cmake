cotan_test(report_test
  SOURCES report_test.cpp report_convert_test.cpp report_lines_test.cpp report_sentences_test.cpp
  LIBRARIES cotan_app cotan_lab_report cotan_scene nlohmann_json::nlohmann_json)
