# Installs the build into a fresh prefix, builds the consumer and the examples against it and runs them; then the pages
# are held against the examples (tests/docs/code_test.py).
file(REMOVE_RECURSE ${WORK})
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN} ended with ${status}:\n${output}${errors}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G ${GENERATOR} -DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}
  -DCMAKE_PREFIX_PATH=${WORK}/prefix -DEXAMPLES=${ROOT}/examples "-DCMAKE_CXX_FLAGS=${FLAGS}"
  -DCMAKE_CXX_COMPILER=${COMPILER})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
run(${WORK}/prefix/bin/vericone --version)

file(GLOB examples RELATIVE ${ROOT}/examples ${ROOT}/examples/*.cpp)
foreach(example IN LISTS examples)
  string(REPLACE .cpp "" example ${example})
  set(arguments "")
  if(example STREQUAL own_mesh)
    set(arguments ${ROOT}/docs/examples/window.obj)
  endif()
  run(${WORK}/build/examples/${example} ${arguments})
  file(WRITE ${WORK}/outputs/${example} "${output}")
endforeach()
run(${CMAKE_COMMAND} -E env VERICONE_SOURCE=${ROOT} VERICONE_OUTPUTS=${WORK}/outputs PYTHONDONTWRITEBYTECODE=1
  /usr/bin/python3 ${ROOT}/tests/docs/code_test.py)
