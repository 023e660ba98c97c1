# Compares whole models, drawn by both renderers, with known facts about them.
cotan_test(models_test SLOW MaterialModels.*
  SOURCES models_normal_tangent_test.cpp models_uv_cases_test.cpp models_devices_test.cpp
          models_materials_test.cpp models_extensions_test.cpp
  LIBRARIES cotan_render cotan_scene cotan_model cotan_inspect cotan_bake cotan_truth)
