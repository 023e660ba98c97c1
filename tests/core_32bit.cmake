# Builds src/core and tests/core_32bit.cpp for 32 bits and runs them; not optimised, which may hide a shift
# that is too far. CXX, FLAGS, SOURCE (the repository), OUT (a folder). Says "skipped:" where the compiler has
# no 32-bit libraries.
file(MAKE_DIRECTORY ${OUT})
separate_arguments(FLAGS UNIX_COMMAND "${FLAGS}")
file(WRITE ${OUT}/empty.cpp "#include <thread>\nint main() { std::thread([] {}).join(); }\n")
execute_process(COMMAND ${CXX} -std=c++20 ${FLAGS} ${OUT}/empty.cpp -o ${OUT}/empty -pthread
  RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
if(NOT failed)
  execute_process(COMMAND ${OUT}/empty RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
endif()
if(failed)
  message("skipped: ${CXX} ${FLAGS} makes no program that runs; on Debian 12: lib32stdc++-12-dev libc6-dev-i386")
  return()
endif()

# All of it as one file: most of the time is what each includes.
file(GLOB core ${SOURCE}/src/core/*.cpp)
list(TRANSFORM core REPLACE "(.+)" "#include \"\\1\"\n")
list(JOIN core "" text)
file(WRITE ${OUT}/core.cpp "${text}")
execute_process(
  COMMAND ${CXX} -std=c++20 -O0 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror ${FLAGS} -pthread
    -I${SOURCE}/include -I${SOURCE}/shaders ${OUT}/core.cpp ${SOURCE}/tests/core_32bit.cpp -o ${OUT}/core_32bit
  RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "src/core does not compile for 32 bits")
endif()
execute_process(COMMAND ${OUT}/core_32bit RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "src/core is wrong on 32 bits: ${failed}")
endif()
