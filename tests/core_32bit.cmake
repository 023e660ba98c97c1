# Builds src/core with tests/core_facts.cpp, and the C API's array functions with tests/c_facts.cpp, for 32 bits and
# runs them, without optimisation, which could hide a shift that is too large. Variables: CXX, FLAGS, SOURCE (the
# repository), OUT (a folder). Prints "skipped:" if the compiler has no 32-bit libraries.
file(MAKE_DIRECTORY ${OUT})
separate_arguments(FLAGS UNIX_COMMAND "${FLAGS}")
file(WRITE ${OUT}/empty.cpp "#include <thread>\nint main() { std::thread([] {}).join(); }\n")
execute_process(COMMAND ${CXX} -std=c++20 ${FLAGS} ${OUT}/empty.cpp -o ${OUT}/empty -pthread
  RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
if(NOT failed)
  execute_process(COMMAND ${OUT}/empty RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
endif()
if(failed)
  message("skipped: ${CXX} ${FLAGS} makes no program that runs; scripts/setup test installs its 32-bit libraries")
  return()
endif()

# Joins the files of a part, at most `most` at a time, since names in unnamed namespaces could clash.
function(joined part most)
  file(GLOB files ${SOURCE}/src/${part}/*.cpp)
  set(made "")
  while(files)
    list(SUBLIST files 0 ${most} batch)
    list(REMOVE_ITEM files ${batch})
    list(TRANSFORM batch REPLACE "(.+)" "#include \"\\1\"\n")
    string(CONCAT text ${batch})
    list(LENGTH made number)
    file(WRITE ${OUT}/${part}${number}.cpp "${text}")
    list(APPEND made ${OUT}/${part}${number}.cpp)
  endwhile()
  set(${part} ${made} PARENT_SCOPE)
endfunction()
joined(core 100)
joined(maps 8)

function(compile what)
  execute_process(
    COMMAND ${CXX} -std=c++20 -O0 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
      -Wno-unknown-warning-option -Wno-subobject-linkage -Werror ${FLAGS}
      -pthread -DGLM_FORCE_XYZW_ONLY -DCOTAN_VERSION="0.0.0" -I${SOURCE}/src -I${SOURCE}/src/core/include -I${SOURCE}/shaders
      -I${SOURCE}/src/c/include -I${SOURCE}/src/scene/include -I${SOURCE}/src/maps/include
      -I${SOURCE}/src/c ${ARGN}
    RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${what} does not compile for 32 bits")
  endif()
endfunction()

# Builds the program `name` from the sources and the core, and runs it.
function(run_32bit name)
  compile(${name} ${ARGN} ${OUT}/core.o -o ${OUT}/${name})
  execute_process(COMMAND ${OUT}/${name} RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${name}, wrong on 32 bits: ${failed}")
  endif()
endfunction()

compile(src/core ${core} -c -o ${OUT}/core.o) # all files of the core are one batch
run_32bit(core_facts ${SOURCE}/tests/core_facts.cpp)
run_32bit(c_facts ${maps} ${SOURCE}/src/c/geometry_api.cpp ${SOURCE}/src/c/library.cpp ${SOURCE}/src/c/maps_api.cpp
  ${SOURCE}/tests/c_facts.cpp)
