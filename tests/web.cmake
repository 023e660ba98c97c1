# The npm package of bindings/js: built as a test that others need, since it takes minutes the first time and most who
# build have no emscripten. Skipped where that or npm is missing.
set(tarball ${PROJECT_BINARY_DIR}/web/npm/cotan-${PROJECT_VERSION}.tgz)
add_test(NAME web_package COMMAND ${PROJECT_SOURCE_DIR}/scripts/npm-package ${PROJECT_BINARY_DIR}/web)
set_tests_properties(web_package PROPERTIES FIXTURES_SETUP web SKIP_RETURN_CODE 3 TIMEOUT 1200 COST 200)
find_program(COTAN_NODE node)
if(NOT COTAN_NODE)
  cotan_without(Node.js "not found: install nodejs" "no tests of the npm package and of the page")
  return()
endif()
# cotan_web_test(FILE ARGUMENTS... CASES...): each case is a test by itself.
function(cotan_web_test file)
  cmake_parse_arguments(WEB "" "" "ARGUMENTS;CASES" ${ARGN})
  foreach(case ${WEB_CASES})
    add_test(NAME Web.${case} COMMAND ${COTAN_NODE} --expose-gc ${CMAKE_CURRENT_SOURCE_DIR}/web/${file}.mjs ${tarball}
      ${WEB_ARGUMENTS} ${case})
    set_tests_properties(Web.${case} PROPERTIES FIXTURES_REQUIRED "web;npm" SKIP_RETURN_CODE 77 TIMEOUT 300)
  endforeach()
endfunction()
set(data ${PROJECT_SOURCE_DIR}/../shared/data)
cotan_web_test(package_test ARGUMENTS $<TARGET_FILE:cotan_c> ${data}
  CASES bothWaysOfLoadingWork tangentsAreTheNativeOnesToTheBit lintAndConvertAreTheNativeOnes droppingTangentsNeverMakesAFileLarger
    greenThatTangentsMeanIsNotFixed modesOfConversionAreChosenAndRefused pngFilesLoseNothing
    mapsConvertAndTellTheirGreen errorsSayWhatAndWhere encodePngLooksAtThePictureBeforeItBegins
    sizesThatOverflowThoseOfTheWebAreRefused everyFunctionAnswersNonsenseWithACotanError whatNpmLacksIsSaidForUsersOfNpm badInputLeaksNothing badFilesAreRefusedOrRead itIsSmall)
cotan_web_test(gltf_transform_test ARGUMENTS ${PROJECT_BINARY_DIR}/npm/node_modules ${data}
  CASES indexedPrimitivesGetTheTangentsOfTheirCorners untangentDoesWhatConvertDoes lintNormalsReportsAndChangesNothing
    aModelWithGreenReversedFailsTheCheck newMapsAreForEnginesThatTake2cMinus1 materialsNameTheFrameOfTheirMaps itsCheckHasAThresholdAReportAndAnExitCode
    provokingGivesEachTriangleAVertex compressedModelsComeThroughItsOwnDecoders newMapsAreInTheFormatOfTheOldOnes mapsInKtx2AreNamedWithWhatToDo
    untangentDropsTangentsAndNoFileGrows unknownOptionsAreRefusedAtOnce itsCommandLineRunsOurCommands)
cotan_web_test(three_test ARGUMENTS ${PROJECT_BINARY_DIR}/npm/node_modules ${data}
  CASES greenFollowsReversedTangentsOnNineTenthsOfAMapsArea mixedTangentsLeaveGreenAsDeclaredAndAreNamed
    tangentsThatPointElsewhereDoNotReverseGreen clearCoatsFollowTheSameRule theOptionConventionOverridesTangents
    aSecondCallChangesNothingAndALaterMeshIsReadAsTheFirst autoIsTheFrameThatTheMaterialNamesElseWhatMapsOfModelsMean
    mapsThatAreRepeatedOnShapesOfOnesOwnAreReadAsTheyStretch smoothHasTheCotangentsOfTheLibrary hooksThatComeLaterAreInTheKeyAndKeepTheFrame
    clonesOfMaterialsKeepTheFrame whatTookThePlaceOfAGeometryIsFreedWithIt olderVersionsOfThreeAreTakenAndTooOldOnesNamed
    whatIsUnknownIsRefused)
cotan_web_test(types_test ARGUMENTS ${PROJECT_BINARY_DIR}/npm/node_modules
  CASES typingsTakeEveryExportInStrictMode typingsNameWhatThereIsAndNothingElse wrongCallsAreRefusedLineByLine)
cotan_web_test(bundlers_test ARGUMENTS ${PROJECT_BINARY_DIR}/npm/node_modules
  CASES viteServesIt viteBuildsIt viteBuildsItForNode webpackBuildsIt webpackBuildsItForNode esbuildBuildsIt esbuildBuildsItForNode
    aBrowserLoadsTheFileOfUnpkg)
cotan_web_test(browser_test ARGUMENTS ${PROJECT_BINARY_DIR}/npm/node_modules CASES bundleWorksInABrowserAndAWorker)
cotan_web_test(readme_test ARGUMENTS ${PROJECT_BINARY_DIR}/npm/node_modules
    ${data}/models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb CASES theReadmeBringsAModelWithoutTangentsOnScreen)

# What cotan/three draws by default, from its sources, judged by stock three.js. The cat alone takes a minute.
foreach(fact greenIsReadAsReversedTangentsMeanIt modelsWithTangentsAreDrawnAsWithThem modelsWithoutTangentsAreReadAsMikkTSpace
    mirroredInstancesAreInsideOutWithRightBumps replacedGeometriesAreFreed anOlderThreeDrawsTheSame)
  add_test(NAME ThreeDefaults.${fact} COMMAND ${COTAN_NODE} ${CMAKE_CURRENT_SOURCE_DIR}/web/three_defaults_test.mjs
    ${PROJECT_SOURCE_DIR}/bindings/js ${PROJECT_BINARY_DIR}/npm/node_modules ${data} ${fact})
  set_tests_properties(ThreeDefaults.${fact} PROPERTIES FIXTURES_REQUIRED npm SKIP_RETURN_CODE 77 TIMEOUT 600)
endforeach()

# The jet fighter, whose textures are BasisU, with textures that the tool reads.
add_test(NAME BasisU.aModelWithItsTexturesInPngIsDrawnAsItsTangentsMean COMMAND ${COTAN_NODE}
  ${CMAKE_CURRENT_SOURCE_DIR}/web/basisu_test.mjs ${PROJECT_BINARY_DIR}/npm/node_modules $<TARGET_FILE:cotan> ${data})
set_tests_properties(BasisU.aModelWithItsTexturesInPngIsDrawnAsItsTangentsMean PROPERTIES
  FIXTURES_REQUIRED npm SKIP_RETURN_CODE 77 TIMEOUT 300)

# The page of web/, and what holds of it in Chromium.
add_test(NAME web_page COMMAND ${PROJECT_SOURCE_DIR}/scripts/web-page ${PROJECT_BINARY_DIR}/web)
set_tests_properties(web_page PROPERTIES FIXTURES_REQUIRED web FIXTURES_SETUP page SKIP_RETURN_CODE 3 TIMEOUT 300)
function(cotan_page_test file)
  foreach(fact ${ARGN})
    add_test(NAME Page.${fact} COMMAND ${COTAN_NODE} ${CMAKE_CURRENT_SOURCE_DIR}/web/${file}.mjs ${PROJECT_BINARY_DIR}/web/page
      ${PROJECT_BINARY_DIR}/npm/node_modules $<TARGET_FILE:cotan> ${data} ${fact})
    set_tests_properties(Page.${fact} PROPERTIES FIXTURES_REQUIRED "page;npm" SKIP_RETURN_CODE 77 TIMEOUT 300)
  endforeach()
endfunction()
cotan_page_test(page_maps_test
    aMapWithReversedGreenIsFoundAndFixed verdictsOnPublishedMapsAreTheirs
    aFixedMapHasTheTexelsThatTheCommandLineWrites theShaderIsTheCommandLinesAndTheAddressKeepsTheChoice
    theShaderOfTheFrameTriangleIsGivenByStage webGpuAndWebGlDrawTheSamePictures aLostDeviceLeavesThePicturesToWebGl
    thePatchAnswersKeysAndPointerWithRightDegrees)
cotan_page_test(page_models_test
    aModelIsDrawnTwiceAndTheAngleBetweenIsSaid whatThePageAdvisesIsWhatItShowsAndSaysOnce
    theCheckIsTheCommandLinesWithItsReportAsAFile aModelWithReversedGreenIsFixed whiteKeepsItsBumps
    realModelsAreJudgedAndDrawn aConvertedModelIsTheOneThatTheCommandLineWrites mapsInKtx2AreNamedWithWhatToDo)
cotan_page_test(page_test
    firstViewIsBelow200KBWithoutTheLibrary anOldVerdictGoesWhenANewFileFails
    itWorksUnderTheContentSecurityPolicyThatItStates aLibraryThatDoesNotLoadIsSaidEachTime whatTakesLongSaysSo
    facetsAreAnswered badFilesAreAnsweredInOneLineEach documentsShowTheirPicturesAndTheirLinksLead
    accessibilityRulesHoldInLightAndDark aPhoneShowsAllWithoutScrollingSideways itWorksWithoutANetworkOnceItWasSeen)
