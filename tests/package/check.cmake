# SPDX-License-Identifier: Apache-2.0
# cmake -DBUILD= -DFLAGS= -DGENERATOR= -P: installs BUILD into a prefix of its own and builds and runs a consumer of it.
set(area ${BUILD}/package)
file(REMOVE_RECURSE ${area})

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    string(REPLACE ";" " " command "${ARGV}")
    message(FATAL_ERROR "${command}\n${output}")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${area}/prefix)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${area}/build -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${area}/prefix -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF)
run(${CMAKE_COMMAND} --build ${area}/build)
run(${area}/build/own_initiator)
run(${area}/build/own_memory)
run(${area}/build/own_exploration)
run(${area}/build/own_circuit --timing-frames 1 --no-verdict)
