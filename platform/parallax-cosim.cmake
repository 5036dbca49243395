# SPDX-License-Identifier: Apache-2.0
# parallax_add_cosim(NAME STAGE STAGE SOURCES FILE... [TOP NAME] [PARAMETERS NAME=VALUE...] [INCLUDES DIR...]
# [DEFINES NAME[=VALUE]...] [OPTIONS OPTION...]): a program NAME that is `parallax run` with a circuit in Verilog in the place of a stage. It takes all options of that, after OPTIONS.
function(parallax_add_cosim name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "STAGE;TOP" "SOURCES;PARAMETERS;INCLUDES;DEFINES;OPTIONS")
  if(arg_UNPARSED_ARGUMENTS OR arg_KEYWORDS_MISSING_VALUES OR NOT arg_STAGE OR NOT arg_SOURCES)
    message(FATAL_ERROR
      "parallax_add_cosim(${name}): STAGE and SOURCES are needed, TOP, PARAMETERS, INCLUDES, DEFINES and OPTIONS may "
      "follow; "
      "not: ${arg_UNPARSED_ARGUMENTS} ${arg_KEYWORDS_MISSING_VALUES}")
  endif()
  set(sources)
  foreach(source ${arg_SOURCES})
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    list(APPEND sources ${source})
  endforeach()
  set(built)
  if(arg_TOP)
    list(APPEND built --circuit-top ${arg_TOP})
  endif()
  foreach(parameter ${arg_PARAMETERS})
    list(APPEND built --circuit-parameter ${parameter})
  endforeach()
  foreach(folder ${arg_INCLUDES})
    cmake_path(ABSOLUTE_PATH folder BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    list(APPEND built --circuit-include ${folder})
  endforeach()
  foreach(define ${arg_DEFINES})
    list(APPEND built --circuit-define ${define})
  endforeach()
  set(library ${CMAKE_CURRENT_BINARY_DIR}/${name}.so)
  add_custom_command(OUTPUT ${library} DEPENDS ${sources} VERBATIM
    COMMAND parallax::parallax circuit ${sources} ${built} --out ${library})
  add_custom_target(${name}_circuit DEPENDS ${library})

  set(words run --circuit ${arg_STAGE}=${library} ${arg_OPTIONS})
  list(TRANSFORM words PREPEND "R\"word(")
  list(TRANSFORM words APPEND ")word\"")
  list(JOIN words ", " words)
  file(CONFIGURE OUTPUT ${name}.cpp @ONLY CONTENT [[
// What parallax_add_cosim() made: the program with these words in front of those that it is called with.
#include <unistd.h>

#include <cstdio>
#include <vector>

int main(int argc, char** argv) {
  std::vector<const char*> words{PARALLAX_PROGRAM, @words@};
  words.insert(words.end(), argv + 1, argv + argc);
  words.push_back(nullptr);
  execv(PARALLAX_PROGRAM, const_cast<char**>(words.data()));
  std::perror(PARALLAX_PROGRAM);
  return 2;
}
]])
  add_executable(${name} ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_compile_definitions(${name} PRIVATE PARALLAX_PROGRAM="$<TARGET_FILE:parallax::parallax>")
  add_dependencies(${name} ${name}_circuit)
endfunction()
