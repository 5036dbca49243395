# SPDX-License-Identifier: Apache-2.0
# cmake -DBUILD= -DFLAGS= -DGENERATOR= [-DPYTHON=] -P: installs BUILD into a prefix of its own and builds and runs a consumer of it.
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
foreach(page README.md platform/doc/rtl.md modules/README.md modules/census.hpp modules/rtl/census.sv)
  if(NOT EXISTS ${area}/prefix/share/doc/parallax/${page})
    message(FATAL_ERROR "the guide that is installed has no ${page}")
  endif()
endforeach()
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${area}/build -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${area}/prefix -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF)
run(${CMAKE_COMMAND} --build ${area}/build)
run(${area}/build/own_initiator)
run(${area}/build/own_pins)
run(${area}/build/own_memory)
run(${area}/build/own_exploration)
run(${area}/build/own_circuit --timing-frames 1 --no-verdict)

# The Python module is where it is installed all that it needs.
if(PYTHON)
  file(GLOB folder ${area}/prefix/lib/python3*/dist-packages)
  run(${CMAKE_COMMAND} -E env PYTHONPATH=${folder} ${PYTHON} -c
    "import parallax; print(parallax.Machine('core-alone').time(size=(96, 64), rectified=True)['performance/frame_rate'])")
endif()

# A test bench in SystemVerilog that asks the installed library (DPI-C), with a circuit that is right and one that is not.
file(GLOB_RECURSE library ${area}/prefix/libparallax_stage.so)
cmake_path(GET library PARENT_PATH library_folder)
foreach(fault NONE COMPARISON)
  run(verilator --binary --timing --top-module census_bench -DFAULT_${fault} -Mdir ${area}/bench_${fault}
    ${area}/prefix/share/parallax/stage/parallax_stage.sv ${CMAKE_CURRENT_LIST_DIR}/census_bench.sv
    ${CMAKE_CURRENT_LIST_DIR}/../rtl/census_5x5.sv ${library} -LDFLAGS -Wl,-rpath,${library_folder})
  execute_process(COMMAND ${CMAKE_COMMAND} -E env PARALLAX=${area}/prefix/bin/parallax ${area}/bench_${fault}/Vcensus_bench
    RESULT_VARIABLE ended OUTPUT_VARIABLE said ERROR_VARIABLE said)
  set(expected "PASS 3072 codes of each image")
  if(NOT fault STREQUAL "NONE")
    set(expected "out_left: the first difference is token 0 \\(pass 0, row 0, token 0 of the row\\): expected [0-9a-f]+, got [0-9a-f]+")
  endif()
  if(NOT said MATCHES "${expected}" OR (fault STREQUAL "NONE" AND NOT ended EQUAL 0) OR
      (NOT fault STREQUAL "NONE" AND ended EQUAL 0))
    message(FATAL_ERROR "census_bench with the fault ${fault} ended with ${ended}:\n${said}")
  endif()
endforeach()
