// SPDX-License-Identifier: Apache-2.0
// Readers of file formats that have nothing in common with what writes them: modules of Python.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "tests/platform/temporary_folder.hpp"

namespace parallax::test {

/// Whether Debian's python3 has the module: else a test skips.
inline bool python_has(const std::string& module) {
  return std::system(("/usr/bin/python3 -c 'import " + module + "' 2>/dev/null").c_str()) == 0;
}

/// What a script prints that runs in `folder`. Throws when the script fails.
inline std::string python(const TemporaryFolder& folder, const std::string& script) {
  folder.write("script.py", script);
  const std::string command = "cd '" + folder.path().string() + "' && /usr/bin/python3 script.py >printed";
  if (std::system(command.c_str()) != 0) throw std::runtime_error("the Python script fails");
  return folder.read("printed");
}

}  // namespace parallax::test
