# The npm package of bindings/js. It is built as a test that others require, because it takes minutes the first time and
# most developers have no emscripten. Skipped if emscripten or npm is missing.
set(tarball ${PROJECT_BINARY_DIR}/web/npm/cotan-${PROJECT_VERSION}.tgz)
add_test(NAME web_package COMMAND ${PROJECT_SOURCE_DIR}/scripts/npm-package ${PROJECT_BINARY_DIR}/web)
set_tests_properties(web_package PROPERTIES FIXTURES_SETUP web SKIP_RETURN_CODE 3 TIMEOUT 1200 COST 200)
cotan_slow(web_package)
find_program(COTAN_NODE node)
if(NOT COTAN_NODE)
  cotan_without(Node.js "not found: install nodejs" "no tests of the npm package and of the page")
  return()
endif()
# cotan_web_test(NAME ARGUMENTS ... FIXTURES ...): the cases of tests/web/NAME_test.mjs, which share one process, one
# installation of the package and one browser. A case runs by itself if its name follows the arguments that `ctest -V`
# prints.
function(cotan_web_test name)
  cmake_parse_arguments(WEB "" "" "ARGUMENTS;FIXTURES" ${ARGN})
  set(test Web.${name})
  add_test(NAME ${test} COMMAND ${COTAN_NODE} --expose-gc ${CMAKE_CURRENT_SOURCE_DIR}/web/${name}_test.mjs ${WEB_ARGUMENTS})
  set_tests_properties(${test} PROPERTIES FIXTURES_REQUIRED "${WEB_FIXTURES}" SKIP_RETURN_CODE 77 TIMEOUT 900)
  cotan_slow(${test})
endfunction()
set(modules ${PROJECT_BINARY_DIR}/npm/node_modules)
cotan_web_test(package ARGUMENTS ${tarball} $<TARGET_FILE:cotan_c> FIXTURES web npm)
foreach(name instance zip)
  cotan_web_test(${name} ARGUMENTS ${tarball} FIXTURES web npm)
endforeach()
foreach(name arguments gltf_transform model_viewer one_file react three three_choice types bundlers browser readme)
  cotan_web_test(${name} ARGUMENTS ${tarball} ${modules} FIXTURES web npm)
endforeach()

cotan_web_test(textures ARGUMENTS ${tarball} ${PROJECT_SOURCE_DIR}/build/npm/npm/cotan-${PROJECT_VERSION}.tgz $<TARGET_FILE:cotan> ${modules}
  FIXTURES web npm)

# The command of the package, which `scripts/npm-package build/npm build/web-libraries` makes; compared with the tool.
find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND)
  add_test(NAME Web.tool COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/npm_tool_test.py
    ${PROJECT_SOURCE_DIR}/build/npm/npm/cotan-${PROJECT_VERSION}.tgz $<TARGET_FILE:cotan>)
  set_tests_properties(Web.tool PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 900)
  cotan_slow(Web.tool)
endif()

# Names of files that the command has on Windows.
cotan_web_test(file_names ARGUMENTS ${PROJECT_SOURCE_DIR}/bindings/js)

# The crate for Bevy. With COTAN_BEVY, a clone of Bevy, its shaders take the place of stand-ins.
cotan_web_test(bevy ARGUMENTS ${modules} $<TARGET_FILE:cotan> FIXTURES npm)

# Compares cotan/three with its defaults, from its sources, with stock three.js.
cotan_web_test(three_defaults ARGUMENTS ${PROJECT_SOURCE_DIR}/bindings/js ${modules} FIXTURES npm)

# Anisotropy and clear coats whose maps have texture coordinates of their own.
cotan_web_test(three_directions ARGUMENTS ${PROJECT_SOURCE_DIR}/bindings/js ${modules} FIXTURES npm)

# The edges of triangles and of control flow, by the printed text alone.
cotan_web_test(edges ARGUMENTS ${modules} $<TARGET_FILE:cotan> FIXTURES npm)

# Height maps in three.js, compared with rays against the displaced surface; and what stock three.js draws instead.
cotan_web_test(three_beyond ARGUMENTS ${PROJECT_SOURCE_DIR}/bindings/js ${modules} $<TARGET_FILE:cotan> FIXTURES npm)
cotan_web_test(three_relief ARGUMENTS ${PROJECT_SOURCE_DIR}/bindings/js ${modules} FIXTURES npm)

# The lines of docs/how-to/three-normal-maps.md in stock three.js, compared with an analytic relief.
cotan_web_test(three_symptoms ARGUMENTS ${PROJECT_SOURCE_DIR}/bindings/js ${modules} FIXTURES npm)

# The blocks of GPU textures that the tool writes, in stock three.js and Babylon.js.
cotan_web_test(blocks ARGUMENTS ${PROJECT_SOURCE_DIR} ${modules} $<TARGET_FILE:cotan> FIXTURES npm)
cotan_web_test(basisu_models ARGUMENTS ${PROJECT_SOURCE_DIR}/bindings/js ${modules} $<TARGET_FILE:cotan> FIXTURES npm)

# The pages of examples/ as they are shipped.
cotan_web_test(examples ARGUMENTS ${PROJECT_SOURCE_DIR} ${modules} FIXTURES npm)

# The table of bench/models-in-three, which draws for half an hour: its rules and its page.
add_test(NAME ModelsTable.isCheckedAndShown COMMAND ${COTAN_NODE} ${CMAKE_CURRENT_SOURCE_DIR}/web/models_table_test.mjs)

# The jet fighter, whose textures are BasisU, and a copy with PNG textures that another decoder made.
add_test(NAME BasisU.aModelIsDrawnLintedAndConvertedAsWithPngTextures COMMAND ${COTAN_NODE}
  ${CMAKE_CURRENT_SOURCE_DIR}/web/basisu_test.mjs ${PROJECT_BINARY_DIR}/npm/node_modules $<TARGET_FILE:cotan>)
set_tests_properties(BasisU.aModelIsDrawnLintedAndConvertedAsWithPngTextures PROPERTIES
  FIXTURES_REQUIRED npm SKIP_RETURN_CODE 77 TIMEOUT 300)
cotan_slow(BasisU.aModelIsDrawnLintedAndConvertedAsWithPngTextures)

# Builds the page of web/, and tests it in Chromium.
add_test(NAME web_page COMMAND ${PROJECT_SOURCE_DIR}/scripts/web-page ${PROJECT_BINARY_DIR}/web)
set_tests_properties(web_page PROPERTIES FIXTURES_REQUIRED web FIXTURES_SETUP page SKIP_RETURN_CODE 3 TIMEOUT 300)
cotan_slow(web_page)
foreach(name page page_disk page_maps page_models)
  cotan_web_test(${name} ARGUMENTS ${PROJECT_BINARY_DIR}/web/page ${modules} $<TARGET_FILE:cotan> FIXTURES page npm)
endforeach()
