# SPDX-License-Identifier: Apache-2.0
# The control circuits of tests/rtl as C++ libraries, where PARALLAX_RTL is on.
find_package(verilator QUIET)
if(NOT verilator_FOUND)
  set(PARALLAX_RTL OFF)
  message(STATUS "Verilator is not installed: no tests against RTL (tests/run installs what they need)")
elseif(PARALLAX_SANITIZE)
  set(PARALLAX_RTL OFF)  # a minute of compiling generated code, to see dates again that the other build sees
  message(STATUS "Built with sanitizers: no tests against RTL")
else()
  set(PARALLAX_RTL ON)
endif()

# parallax_verilated(LIBRARY CLASS TOP [TRACE] [OPTIMISE -O1] [PARAMETER=VALUE...]): adds module TOP of tests/rtl/TOP.sv to the
# static library LIBRARY, as class CLASS in header CLASS.h, compiled with -O2 or as told.
function(parallax_verilated library class top)
  set(folder ${PROJECT_SOURCE_DIR}/tests/rtl)
  cmake_parse_arguments(PARSE_ARGV 3 "" "TRACE" "OPTIMISE" "")
  if(NOT _OPTIMISE)
    set(_OPTIMISE -O2)
  endif()
  set(trace)
  if(_TRACE)
    set(trace TRACE)  # it can dump its waves
  endif()
  list(TRANSFORM _UNPARSED_ARGUMENTS PREPEND -G)
  if(NOT TARGET ${library})
    add_library(${library} STATIC EXCLUDE_FROM_ALL)
  endif()
  verilate(${library} SOURCES ${folder}/${top}.sv TOP_MODULE ${top} PREFIX ${class} INCLUDE_DIRS ${folder} ${trace}
    VERILATOR_ARGS -Wall --no-timing --x-assign fast --x-initial fast ${_UNPARSED_ARGUMENTS}
    OPT_SLOW -O0 OPT_FAST ${_OPTIMISE} OPT_GLOBAL -O1)
  # The generated code takes none of our warnings: it gets none of our options, and its headers are system headers.
  get_target_property(includes ${library} INTERFACE_INCLUDE_DIRECTORIES)
  set_target_properties(${library} PROPERTIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${includes}")
endfunction()
