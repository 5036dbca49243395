// SPDX-License-Identifier: Apache-2.0
#include "platform/results/file_content.hpp"

#include <gtest/gtest.h>

namespace parallax {
namespace file_content_test {

// The check value of CRC-32 in the catalogues of such codes.
TEST(FileContent, IsBytesAndTheirCrc) {
  FileContent content;
  content.add("1234", 4);
  content.add("", 0);
  content.add("56789", 5);
  EXPECT_EQ(content.bytes, 9U);
  EXPECT_EQ(content.crc, 0xCBF43926U);
}

}  // namespace file_content_test
}  // namespace parallax
