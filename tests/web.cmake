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
# cotan_web_test(FILE ARGUMENTS... CASES...): each case is a test of its own.
function(cotan_web_test file)
  cmake_parse_arguments(WEB "" "" "ARGUMENTS;CASES" ${ARGN})
  foreach(case ${WEB_CASES})
    add_test(NAME Web.${case} COMMAND ${COTAN_NODE} --expose-gc ${CMAKE_CURRENT_SOURCE_DIR}/web/${file}.mjs ${tarball}
      ${WEB_ARGUMENTS} ${case})
    set_tests_properties(Web.${case} PROPERTIES FIXTURES_REQUIRED "web;npm" SKIP_RETURN_CODE 77 TIMEOUT 300)
    cotan_slow(Web.${case})
  endforeach()
endfunction()
cotan_web_test(package_test ARGUMENTS $<TARGET_FILE:cotan_c>
  CASES bothEntryPointsLoad tangentsEqualTheNativeOnes lintAndConvertMatchTheNativeOnes droppingTangentsNeverMakesAFileLarger
    greenThatTangentsReverseIsNotFixed modesOfConversionAreChosenAndRefused maxDegreesMovesTheChoiceInLintAndConvert filesAreFoundByTheirUrisAsWrittenOrDecoded pngFilesRoundTrip
    mapsConvertAndTheirGreenIsDetected errorsNameTheFieldAndTheFault encodePngValidatesItsImageFirst
    sizesThatOverflow32BitsAreRefused everyFunctionRefusesNonsenseWithACotanError missingDecodersAreExplainedForNpmUsers badInputLeaksNothing badFilesAreRefusedOrRead namesOfTheLastVersionWork packageIsSmall)
cotan_web_test(instance_test CASES everyKindOfThrowGivesAFreshInstance aNestedFaultEndsTheOuterCallToo aFailedRestartIsReportedAndTriedAgain
    fullStacksLeaveNothingBehindInBothModules errorsOfCallbacksAreNoFaults)
cotan_web_test(zip_test CASES zipsOfOtherProgramsAreRead hostileZipsAreRefused damagedZipsGiveTheirFilesOrOneLine)
cotan_web_test(arguments_test ARGUMENTS ${PROJECT_BINARY_DIR}/npm/node_modules
  CASES everyArgumentOfTheTangents everyArgumentOfTheWholePackage everyOptionOfTheTransforms everyArgumentForThree)
cotan_web_test(gltf_transform_test ARGUMENTS ${PROJECT_BINARY_DIR}/npm/node_modules
  CASES indexedPrimitivesGetTheTangentsOfTheirCorners untangentMatchesConvert greenIsDecidedByEveryMeshThatShowsTheMap lintNormalsReportsAndChangesNothing
    aModelWithGreenReversedFailsTheCheck newMapsAreEncodedFor2cMinus1 materialsNameTheFrameOfTheirMaps checkCommandHasALimitAReportAndAnExitCode
    provokingGivesEachTriangleItsOwnVertex compressedModelsAreReadByTheDecodersOfGltfTransform newMapsKeepTheFormatOfTheOldOnes ktx2MapsAreReportedWithAdvice
    webpMapsAreReadAndStayWebp lossesOfAnEncoderAreMeasuredAndVisibleOnesAvoided anEncoderOfTheCallerIsChecked
    conversionsMakeNoNewErrorsOfTheValidator untangentDropsTangentsAndNoFileGrows unknownOptionsAreRefusedAtOnce gltfTransformRunsOurCommands)
cotan_web_test(three_test ARGUMENTS ${PROJECT_BINARY_DIR}/npm/node_modules
  CASES greenFollowsTheTangentsOfEachMesh aMeshWithoutTangentsStaysAsDeclaredWhateverOthersStore
    tangentsThatAreReversedInPartsStay tangentsBelongToTheUvBeforeTheTexturesTransform
    tangentsSayNothingOfMapsForOtherFrames tangentsThatPointElsewhereDoNotReverseGreen clearCoatsFollowTheSameRule theOptionConventionOverridesTangents
    repeatedCallsAndLaterMeshesAgree autoIsTheFrameOfTheMaterialOrOrthonormal
    repeatedMapsOnOwnShapesUseCotangent smoothUsesTheCotangentsOfTheLibrary laterHooksAreInTheKeyAndKeepTheFrame
    clonesOfMaterialsKeepTheFrame replacementsAreFreedWithTheOriginal olderVersionsOfThreeWorkAndTooOldOnesAreRefused
    materialsOfOneFrameShareAProgramAndOthersDoNot nodesOfAUserReadMapsForMikkTSpaceUnlessAFrameIsNamed
    unknownArgumentsAreRefused)
cotan_web_test(three_choice_test ARGUMENTS ${PROJECT_BINARY_DIR}/npm/node_modules
  CASES theFirstCandidateWithinTheLimitsIsTaken vectorsAreMadeWhereOnlyTheyFit loadedTangentsThatMikkTSpaceMakesArePacked maxDegreesMovesTheChoice errorsAreAnglesBetweenPerturbedNormals
    tangentsMadeAtLoadAreThoseOfMikkTSpace madeTangentsComeWithTheScaleThatTheyNeed
    twoCallsOfOneFileDecideTheSameAndASecondCallChangesNothing sharedMaterialsAndGeometriesAreCopiedWhereMeshesDiffer
    materialsOfAMeshAgreeAboutTangents namesOfPrimitivesGoBeforeThoseOfMaterials mapsThatCannotBeReadKeepWhatIsThere
    quantisedAndInterleavedAttributesDecideTheSame skinnedMeshesAreJudgedAsTheyArePosed morphedMeshesGetNoCovectors
    instancesCountByTheWorstStretch flatShadedMeshesNeedNoTangents coatsWithTheSameUvCountToo
    thePluginLeavesItsDecisionsWithTheModel nodesFollowTheSameRule theCodeIsBelow15KB)
cotan_web_test(types_test ARGUMENTS ${PROJECT_BINARY_DIR}/npm/node_modules
  CASES typingsAcceptEveryExportInStrictMode typingsMatchTheExports everyWrongCallIsATypeError)
cotan_web_test(bundlers_test ARGUMENTS ${PROJECT_BINARY_DIR}/npm/node_modules
  CASES viteServesThePackage viteBundlesForTheBrowser viteBundlesForNode webpackBundlesForTheBrowser webpackBundlesForNode esbuildBundlesForTheBrowser esbuildBundlesForNode
    bundlersLoadTheNodesOfThreeDirectly browsersLoadTheFileOfUnpkg)
cotan_web_test(browser_test ARGUMENTS ${PROJECT_BINARY_DIR}/npm/node_modules CASES bundleWorksInABrowserAndAWorker)
cotan_web_test(readme_test ARGUMENTS ${PROJECT_BINARY_DIR}/npm/node_modules CASES theReadmeShowsAModelWithoutTangents)

# Compares cotan/three with its defaults, from its sources, with stock three.js. The cat alone takes a minute.
foreach(fact reversedTangentsReverseGreen modelsLookTheSameWithoutTheirTangents
    nodeMaterialsOfAModelKeepTheirOwnMaps modelsWithoutTangentsAreReadAsMikkTSpace
    mirroredInstancesKeepTheirBumps tangentsThatThreeDrawsAreRightAlsoOnMirroredMeshes replacedGeometriesAreFreed
    anOlderThreeDrawsTheSame)
  add_test(NAME ThreeDefaults.${fact} COMMAND ${COTAN_NODE} ${CMAKE_CURRENT_SOURCE_DIR}/web/three_defaults_test.mjs
    ${PROJECT_SOURCE_DIR}/bindings/js ${PROJECT_BINARY_DIR}/npm/node_modules ${fact})
  set_tests_properties(ThreeDefaults.${fact} PROPERTIES FIXTURES_REQUIRED npm SKIP_RETURN_CODE 77 TIMEOUT 600)
  cotan_slow(ThreeDefaults.${fact})
endforeach()

# The table of bench/models-in-three, which draws for half an hour: its rules and its page.
foreach(fact everyBrokenBarIsNamed predictionsThatDifferFromTheMeasuredDegreesAreNamed
    viewsMayBeNearerThanPredictedAndAreNamed furtherModelsAreNotCounted aRowHasWhatWasMeasured
    thePageShowsItsNumbersAndAllBarsHold)
  add_test(NAME ModelsTable.${fact} COMMAND ${COTAN_NODE} ${CMAKE_CURRENT_SOURCE_DIR}/web/models_table_test.mjs ${fact})
endforeach()

# The jet fighter, whose BasisU textures are replaced by ones that the tool reads.
add_test(NAME BasisU.aModelWithPngTexturesIsDrawnAsItsTangentsMean COMMAND ${COTAN_NODE}
  ${CMAKE_CURRENT_SOURCE_DIR}/web/basisu_test.mjs ${PROJECT_BINARY_DIR}/npm/node_modules $<TARGET_FILE:cotan>)
set_tests_properties(BasisU.aModelWithPngTexturesIsDrawnAsItsTangentsMean PROPERTIES
  FIXTURES_REQUIRED npm SKIP_RETURN_CODE 77 TIMEOUT 300)
cotan_slow(BasisU.aModelWithPngTexturesIsDrawnAsItsTangentsMean)

# Builds the page of web/, and tests it in Chromium.
add_test(NAME web_page COMMAND ${PROJECT_SOURCE_DIR}/scripts/web-page ${PROJECT_BINARY_DIR}/web)
set_tests_properties(web_page PROPERTIES FIXTURES_REQUIRED web FIXTURES_SETUP page SKIP_RETURN_CODE 3 TIMEOUT 300)
cotan_slow(web_page)
function(cotan_page_test file)
  foreach(fact ${ARGN})
    add_test(NAME Page.${fact} COMMAND ${COTAN_NODE} ${CMAKE_CURRENT_SOURCE_DIR}/web/${file}.mjs ${PROJECT_BINARY_DIR}/web/page
      ${PROJECT_BINARY_DIR}/npm/node_modules $<TARGET_FILE:cotan> ${fact})
    set_tests_properties(Page.${fact} PROPERTIES FIXTURES_REQUIRED "page;npm" SKIP_RETURN_CODE 77 TIMEOUT 300)
    cotan_slow(Page.${fact})
  endforeach()
endfunction()
cotan_page_test(page_maps_test
    aMapWithReversedGreenIsFoundAndFixed publishedMapsGetTheirVerdicts
    fixedMapsEqualThoseOfTheCommandLine shadersEqualTheCommandLinesAndTheAddressKeepsTheChoice
    theFirstShaderIsForMapsThatWereBakedForMikkTSpace shadersOfTheFrameTriangleAreGivenByStage
    webGpuAndWebGlDrawTheSameImages webGlReplacesALostDevice thePatchFollowsKeysAndPointerWithRightDegrees)
cotan_page_test(page_models_test
    modelsAreDrawnTwiceWithTheAngleBetween theViewShowsTheAdvisedConversion theDecisionOfEachPartIsShownAndTheLimitCounts
    theCheckAndItsReportMatchTheCommandLine aModelWithReversedGreenIsFixed whiteSurfacesShowTheirBumps
    theVerdictComesBeforeTheView aLateViewOfAnotherModelIsDropped truncatedModelsAreRefused missingFilesAreNamed zipsAreOpened
    webpMapsAreReadWithoutLosses realModelsAreJudgedAndDrawn convertedModelsEqualThoseOfTheCommandLine ktx2MapsAreReportedWithAdvice)
cotan_page_test(page_test
    firstViewIsBelow200KBWithoutTheLibrary aFailedFileClearsTheOldVerdict
    thePageWorksUnderItsContentSecurityPolicy libraryLoadFailuresAreReportedEachTime aFailedDecoderGivesTheNextFileAFreshWorker longWorkShowsItsDuration
    facetsAreExplained badFilesGiveOneLineEach documentsShowTheirImagesAndTheirLinksWork
    accessibilityRulesHoldInLightAndDark phonesNeedNoSidewaysScrolling thePageWorksOfflineAfterTheFirstVisit)
