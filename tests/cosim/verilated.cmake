# SPDX-License-Identifier: Apache-2.0
# The control circuits of tests/rtl as C++ libraries.
find_package(verilator QUIET)
if(NOT verilator_FOUND)
  message(STATUS "Verilator is not installed: no tests against RTL (tests/run installs what they need)")
endif()

# parallax_verilated(LIBRARY CLASS TOP [PARAMETER=VALUE...]): adds module TOP of tests/rtl/TOP.sv to the static library
# LIBRARY, as class CLASS in header CLASS.h. Needs verilator_FOUND.
function(parallax_verilated library class top)
  set(folder ${PROJECT_SOURCE_DIR}/tests/rtl)
  list(TRANSFORM ARGN PREPEND -G)
  if(NOT TARGET ${library})
    add_library(${library} STATIC EXCLUDE_FROM_ALL)
  endif()
  verilate(${library} SOURCES ${folder}/${top}.sv TOP_MODULE ${top} PREFIX ${class} INCLUDE_DIRS ${folder}
    VERILATOR_ARGS -Wall --no-timing --x-assign fast --x-initial fast ${ARGN} OPT_SLOW -O0 OPT_FAST -O2 OPT_GLOBAL -O1)
  # The generated code takes none of our warnings: it gets none of our options, and its headers are system headers.
  get_target_property(includes ${library} INTERFACE_INCLUDE_DIRECTORIES)
  set_target_properties(${library} PROPERTIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${includes}")
endfunction()
