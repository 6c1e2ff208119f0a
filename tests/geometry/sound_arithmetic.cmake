# A program compiled as the library asks for runs; one whose compiler or linker takes IEEE arithmetic away does not
# compile or refuses to run, and says what is wrong; the command too.
separate_arguments(flags UNIX_COMMAND "${FLAGS}")
file(MAKE_DIRECTORY ${WORK})
function(compile status said)
  execute_process(COMMAND ${COMPILER} -std=c++20 ${flags} -isystem ${INCLUDE} -O2 ${ARGN} -c ${SOURCE} -o ${WORK}/use.o
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  set(${status} "${result}" PARENT_SCOPE)
  set(${said} "${output}" PARENT_SCOPE)
endfunction()
# require(WHAT PATTERN COMPILE-OPTIONS LINK-OPTIONS): the program compiles, links, and says PATTERN; nothing where empty.
function(require what pattern compile_options link_options)
  compile(status said ${compile_options})
  if(status EQUAL 0)
    execute_process(COMMAND ${COMPILER} ${flags} ${link_options} ${WORK}/use.o ${LIBRARY} -o ${WORK}/use
      RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  endif()
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${what}: does not compile or link:\n${said}")
  endif()
  execute_process(COMMAND ${WORK}/use RESULT_VARIABLE status OUTPUT_VARIABLE said)
  if(pattern STREQUAL "" AND NOT status EQUAL 0 OR NOT pattern STREQUAL "" AND NOT "${status}: ${said}" MATCHES "^1: ${pattern}")
    message(FATAL_ERROR "${what}: ended with ${status}: ${said}")
  endif()
endfunction()

require("as the library asks for" "" "-ffp-contract=off" "")
require("linked with -ffast-math" "arithmetic of the library: got subnormal numbers flushed" "-ffp-contract=off" "-ffast-math")
compile(status said -ffast-math)
if(status EQUAL 0 OR NOT said MATCHES "-ffast-math reorders sums")
  message(FATAL_ERROR "-ffast-math: compiled, or refused without saying why:\n${said}")
endif()
file(READ /proc/cpuinfo processor LIMIT 20000)
if(processor MATCHES " fma ")
  require("contraction" "arithmetic of the program: got products fused" "-march=haswell;-ffp-contract=fast" "")
  require("FMA without contraction" "" "-march=haswell;-ffp-contract=off" "")
endif()
# Reordered sums without -ffast-math, which some compilers tell and others do not.
require("reordered sums" "arithmetic of the program: got sums reordered"
  "-ffp-contract=off;-fassociative-math;-fno-signed-zeros;-fno-trapping-math" "")

if(PROGRAM)
  file(WRITE ${WORK}/flush.cpp "#include <xmmintrin.h>\n[[gnu::constructor]] static void flush() { _mm_setcsr(_mm_getcsr() | 0x8040); }\n")
  execute_process(COMMAND ${COMPILER} -shared -fPIC ${WORK}/flush.cpp -o ${WORK}/flush.so RESULT_VARIABLE status)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env LD_PRELOAD=${WORK}/flush.so ${PROGRAM} --version
    RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT "${status}: ${said}" MATCHES "^2: vericone: arithmetic of the library: got subnormal numbers flushed[^\n]*\n$")
    message(FATAL_ERROR "the command: ended with ${status}: ${said}")
  endif()
endif()
