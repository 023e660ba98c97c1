cotan_test(report_test SOURCES report_test.cpp LIBRARIES cotan_report nlohmann_json::nlohmann_json)
