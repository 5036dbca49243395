// SPDX-License-Identifier: Apache-2.0
#include "platform/results/truth_encoding.hpp"

#include <gtest/gtest.h>

#include "tests/platform/error_of.hpp"

namespace parallax {
namespace truth_encoding_test {

TEST(TruthEncodingOption, HasTwoNames) {
  EXPECT_EQ(truth_encoding(""), TruthEncoding::kValues);
  EXPECT_EQ(truth_encoding("values"), TruthEncoding::kValues);
  EXPECT_EQ(truth_encoding("sintel"), TruthEncoding::kSintel);
  EXPECT_EQ(error_of([] { truth_encoding("kitti"); }),
            "--ground-truth-encoding is 'kitti', expected values or sintel");
}

}  // namespace truth_encoding_test
}  // namespace parallax
