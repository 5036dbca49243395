// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/cli/program.hpp"
#include "tests/paths.hpp"

namespace parallax::test {

/// Compiles `source` to NAME.so in the program's folder.
inline void make_library(const Program& program, const std::string& name, const std::string& source) {
  program.folder().write(name + ".cpp", source);
  const std::string command = fmt::format(
      "cd '{0}' && g++ -std=c++17 -shared -fPIC -I'{1}' -I'{1}/platform/cosim/circuit' -o {2}.so {2}.cpp",
      program.folder().path().string(), source_path(""), name);
  ASSERT_EQ(std::system(command.c_str()), 0) << source;
}

/// A circuit (cpp_circuit.hpp) with these pins, as "IN(clk, 1) OUT(out_data, 8)", and this body of
/// evaluate().
inline void make_cpp_circuit(const Program& program, const std::string& name, const std::string& pins,
                             const std::string& evaluate) {
  make_library(program, name,
               fmt::format("#define PINS(IN, OUT) {}\n#include \"tests/cosim/cpp_circuit.hpp\"\n"
                           "static void evaluate([[maybe_unused]] bool rises) {{\n{}\n}}\n",
                           pins, evaluate));
}

}  // namespace parallax::test
