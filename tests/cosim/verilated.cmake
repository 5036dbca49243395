# SPDX-License-Identifier: Apache-2.0
# The control circuits of tests/rtl as C++ libraries, where PARALLAX_RTL is on.
find_package(verilator QUIET)
if(NOT verilator_FOUND)
  set(PARALLAX_RTL OFF)
  message(STATUS "Verilator is not installed: no tests against RTL (tests/run installs what they need)")
else()
  set(PARALLAX_RTL ON)
endif()

# parallax_verilated(LIBRARY CLASS TOP [TRACE] [JOINED] [REFERENCE] [SYSTEMC] [PARAMETER=VALUE...]): adds module TOP of tests/rtl/TOP.sv to
# the static library LIBRARY, as class CLASS in header CLASS.h. TRACE: it can dump its waves. JOINED: it is one unit and not
# optimised, for circuits that compile for longer than they run; otherwise a hundred units would read the same large headers.
# REFERENCE: it is one of modules/rtl, which have ports and outputs of parts that not all of them use.
# SYSTEMC: it is a SystemC module.
function(parallax_verilated library class top)
  set(folder ${PROJECT_SOURCE_DIR}/tests/rtl)
  cmake_parse_arguments(PARSE_ARGV 3 "" "TRACE;JOINED;REFERENCE;SYSTEMC" "" "")
  set(unused)
  if(_REFERENCE)
    set(folder ${PROJECT_SOURCE_DIR}/modules/rtl)
    set(unused -Wno-UNUSED -Wno-PINCONNECTEMPTY)
  endif()
  set(kind)
  foreach(option TRACE SYSTEMC)
    if(_${option})
      list(APPEND kind ${option})
    endif()
  endforeach()
  set(optimise OPT_SLOW -O0 OPT_FAST -O2 OPT_GLOBAL -O1)
  if(_JOINED)
    set(optimise)  # a source with options of its own does not join others
  endif()
  list(TRANSFORM _UNPARSED_ARGUMENTS PREPEND -G)
  if(NOT TARGET ${library})
    add_library(${library} STATIC EXCLUDE_FROM_ALL)
  endif()
  verilate(${library} SOURCES ${folder}/${top}.sv TOP_MODULE ${top} PREFIX ${class} INCLUDE_DIRS ${folder} ${kind}
    VERILATOR_ARGS -Wall ${unused} --no-timing --x-assign fast --x-initial fast ${_UNPARSED_ARGUMENTS} ${optimise})
  if(_JOINED)
    get_target_property(sources ${library} SOURCES)
    list(FILTER sources INCLUDE REGEX "/${class}\\.dir/.*\\.cpp$")
    set_source_files_properties(${sources} PROPERTIES UNITY_GROUP ${class})
    set_target_properties(${library} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    target_compile_options(${library} PRIVATE -O0)
  endif()
  if(_SYSTEMC)
    target_link_libraries(${library} PUBLIC PkgConfig::SystemC)
  endif()
  # The generated code takes none of our warnings: it gets none of our options, and its headers are system headers.
  get_target_property(includes ${library} INTERFACE_INCLUDE_DIRECTORIES)
  set_target_properties(${library} PROPERTIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${includes}")
endfunction()
