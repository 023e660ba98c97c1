cotan_test(core_test
  SOURCES frame_test.cpp degenerate_test.cpp precision_test.cpp normal_test.cpp covector_test.cpp
          convention_test.cpp random_test.cpp fused_test.cpp gradient_test.cpp
          frame_range_test.cpp light_test.cpp light_layers_test.cpp frame_guards_test.cpp normal_codec_test.cpp result_test.cpp
          value_statistics_test.cpp file_names_test.cpp
          space_test.cpp mapping_test.cpp parallax_test.cpp several_maps_test.cpp grooves_test.cpp
  LIBRARIES cotan_truth cotan_core)

# The variant that needs only a compiler and GLM: builds it as shared libraries, installs it and uses it from outside.
if(NOT CMAKE_CXX_FLAGS MATCHES "fsanitize")
  add_test(NAME SmallestBuild.buildsInstallsAndWorks
    COMMAND ${PROJECT_SOURCE_DIR}/scripts/try-smallest ${PROJECT_BINARY_DIR}/smallest ${CMAKE_CXX_COMPILER})
  set_tests_properties(SmallestBuild.buildsInstallsAndWorks PROPERTIES TIMEOUT 300 COST 100 PROCESSORS 2)
  add_test(NAME Consumer.keepsItsCacheVectorTypesAndInstall
    COMMAND ${PROJECT_SOURCE_DIR}/scripts/try-consumer ${PROJECT_BINARY_DIR}/consumer ${CMAKE_CXX_COMPILER})
  set_tests_properties(Consumer.keepsItsCacheVectorTypesAndInstall PROPERTIES TIMEOUT 300 COST 50 PROCESSORS 2)
  cotan_slow(SmallestBuild.buildsInstallsAndWorks Consumer.keepsItsCacheVectorTypesAndInstall)
  add_test(NAME Suite.failsIfALibraryIsMissing
    COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/suite_test.sh ${PROJECT_BINARY_DIR}/suite ${CMAKE_CXX_COMPILER})
  set_tests_properties(Suite.failsIfALibraryIsMissing PROPERTIES TIMEOUT 300)
endif()

# All installed headers in one file, with a JSON library whose headers stop the compiler.
get_property(folders GLOBAL PROPERTY COTAN_INCLUDES)
set(options "")
set(text "")
foreach(folder ${folders})
  get_filename_component(above ${folder} DIRECTORY)
  list(APPEND options -I${above})
  file(GLOB_RECURSE headers RELATIVE ${above} ${folder}/*.hpp)
  list(TRANSFORM headers REPLACE "(.+)" "#include \"\\1\"\n")
  string(APPEND text ${headers})
endforeach()
set(place ${CMAKE_CURRENT_BINARY_DIR}/public_headers)
file(CONFIGURE OUTPUT ${place}/all.cpp CONTENT "${text}" @ONLY)
foreach(header json json_fwd)
  file(WRITE ${place}/nlohmann/${header}.hpp "#error a public header includes a JSON library\n")
endforeach()
add_test(NAME PublicHeaders.compileWithoutAJsonLibrary
  COMMAND ${CMAKE_CXX_COMPILER} -std=c++20 -fsyntax-only -Wall -Wextra -Werror -I${place} ${options}
    -I${PROJECT_BINARY_DIR}/include -I${PROJECT_SOURCE_DIR}/shaders ${place}/all.cpp)

# The structure of the parts: their number, includes and public headers.
if(Python3_FOUND)
  foreach(fact hasFewFolders hasFewLines everySourceIsBuilt hasFewDependencies hasNoDependencyCycle partsIncludeWhatTheyLink eachPartHasOnePublicHeader
      fileNamesAreUnique judgesAreIndependent standardHeadersAreIncludedWhereUsed)
    add_test(NAME Architecture.${fact}
      COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/architecture_test.py ${PROJECT_SOURCE_DIR} ${fact})
  endforeach()
endif()

# What is done in one way everywhere: writing files, waiting for processes.
if(Python3_FOUND)
  foreach(fact filesAreOpenedForWritingByOneFunction filesAreRemovedByTheirOwners filesAreReadByReadersThatNoteThem
      childProcessesAreAwaitedByOneFunction nothingDependsOnTheLocale)
    add_test(NAME OneWay.${fact}
      COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/one_way_test.py ${PROJECT_SOURCE_DIR} ${fact})
  endforeach()
endif()

# The field's terms in messages, names and pages.
if(Python3_FOUND)
  foreach(fact documents messages names pages)
    add_test(NAME Words.${fact}UseTheTermsOfTheField
      COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/words_test.py ${PROJECT_SOURCE_DIR} ${fact}UseTheTermsOfTheField)
  endforeach()
endif()

# Scripts called with wrong arguments, and the programs that they name; who publishes Cotan.
if(Python3_FOUND AND CMAKE_GENERATOR STREQUAL Ninja)
  add_test(NAME Scripts.refuseUnknownArgumentsAndNameWhatTheBuildMakes
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/scripts_test.py ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
  set_tests_properties(Scripts.refuseUnknownArgumentsAndNameWhatTheBuildMakes PROPERTIES TIMEOUT 300)
  cotan_slow(Scripts.refuseUnknownArgumentsAndNameWhatTheBuildMakes)
  add_test(NAME Contact.isNamedOnceItIsFilledIn
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/contact_test.py ${PROJECT_SOURCE_DIR})
endif()

# Adds a frame, an image format and a shader language to a copy of the sources.
if(Python3_FOUND AND TARGET cotan_image AND TARGET OpenImageIO::OpenImageIO)
  add_test(NAME Extending.addsAFrameAFormatAndALanguage
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/extending_test.py ${PROJECT_SOURCE_DIR})
  set_tests_properties(Extending.addsAFrameAFormatAndALanguage PROPERTIES COST 110)
  cotan_slow(Extending.addsAFrameAFormatAndALanguage)
endif()
if(Python3_FOUND)
  add_test(NAME PublicHeaders.beginWithExamplesThatCompile
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/header_examples.py ${PROJECT_SOURCE_DIR} ${place}/examples.cpp
      ${CMAKE_CXX_COMPILER} ${options} -I${PROJECT_BINARY_DIR}/include -I${PROJECT_SOURCE_DIR}/shaders)
endif()

# The portable text compiles unchanged in every language: concatenated, with a few lines that declare the language and
# call every function.
foreach(language glsl essl hlsl)
  if(COTAN_GLSLANG)
    add_test(NAME PortableText.compilesAs_${language}
      COMMAND ${CMAKE_COMMAND}
        -DLANGUAGE=${language} -DGLSLANG=${COTAN_GLSLANG}
        -DSHADERS=${PROJECT_SOURCE_DIR}/shaders -DTESTS=${CMAKE_CURRENT_SOURCE_DIR}
        -DOUT=${CMAKE_CURRENT_BINARY_DIR}/portable_${language}.frag
        -P ${CMAKE_CURRENT_SOURCE_DIR}/portable_text.cmake)
  endif()
endforeach()

# Code that mixes vectors and covectors must not compile, and the same file without the mixture must.
function(cotan_compile_test name definition will_fail)
  add_test(NAME Covector.${name}
    COMMAND ${CMAKE_CXX_COMPILER} -std=c++20 -fsyntax-only -D${definition}
      -I${PROJECT_SOURCE_DIR}/src/core/include -I${PROJECT_SOURCE_DIR}/shaders
      ${CMAKE_CURRENT_SOURCE_DIR}/covector_mixture.cpp)
  set_tests_properties(Covector.${name} PROPERTIES WILL_FAIL ${will_fail})
endfunction()
cotan_compile_test(framesOfOneKindCompile COTAN_MIX_NOTHING OFF)
cotan_compile_test(tangentPlusNormalDoesNotCompile COTAN_MIX_SUM ON)
cotan_compile_test(assigningAVectorToANormalDoesNotCompile COTAN_MIX_ASSIGN ON)
cotan_compile_test(perturbingByTangentsDoesNotCompile COTAN_MIX_FRAME ON)
cotan_compile_test(dotOfTwoCovectorsDoesNotCompile COTAN_MIX_DOT ON)
