// SPDX-License-Identifier: Apache-2.0
#include "tests/paths.hpp"

namespace parallax::test {

std::string source_path(const std::string& name) { return PARALLAX_SOURCE_DIR "/" + name; }

std::string shared_data(const std::string& name) { return source_path("../shared/data/" + name); }

std::string program_path() { return PARALLAX_PROGRAM; }

bool sanitized() {
#ifdef PARALLAX_SANITIZED
  return true;
#else
  return false;
#endif
}

}  // namespace parallax::test
