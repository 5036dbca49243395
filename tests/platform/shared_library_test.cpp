// SPDX-License-Identifier: Apache-2.0
#include "platform/images/shared_library.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace parallax::shared_library_test {

TEST(SharedLibrary, GivesItsFunctions) {
  const SharedLibrary mathematics("libm.so.6");
  EXPECT_EQ(mathematics.function<double(double)>("floor")(2.5), 2);
}

std::string complaint(const char* name, const char* symbol) {
  try {
    SharedLibrary(name).function<void()>(symbol);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(SharedLibrary, SaysWhatIsMissing) {
  EXPECT_EQ(complaint("libnone.so.1", "f"),
            "cannot load a shared library: libnone.so.1: cannot open shared object file: No such file or "
            "directory");
  const std::string without = complaint("libm.so.6", "none");
  EXPECT_EQ(without.find("another shared library is expected: "), 0U) << without;
  EXPECT_NE(without.find("libm.so.6: undefined symbol: none"), std::string::npos) << without;
}

}  // namespace parallax::shared_library_test
