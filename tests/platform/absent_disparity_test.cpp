// SPDX-License-Identifier: Apache-2.0
// What a comparison says of a circuit in which one disparity never wins.
#include "platform/cosim/absent_disparity.hpp"

#include <gtest/gtest.h>

#include "modules/token_formats.hpp"
#include "tests/platform/altered_dump.hpp"

namespace parallax {
namespace absent_disparity_test {

class AbsentDisparity : public test::AlteredDump {
 protected:
  void SetUp() override {
    make(test::image_of(disparity_format(), 64), 64, 48);
    for (std::size_t i = 0; i < words_.size(); ++i)
      words_[i][0] = i % 9 == 0 ? 4095 : words_[i][0] % (32 * 16);
  }
  // Where the model has that disparity, the circuit has another.
  std::string without(std::uint64_t disparity) const {
    return said([disparity](const ValuePlace& place, std::uint64_t value) {
      return value != 4095 && value / 16 == disparity ? 80 + static_cast<std::uint64_t>(place.row * 7)
                                                      : value;
    });
  }
};

TEST_F(AbsentDisparity, TheFirstOrTheLast) {
  EXPECT_EQ(without(31),
            "all that differ have the disparity 31 px in the model, its greatest, which is nowhere in the "
            "circuit's: "
            "it never wins");
  EXPECT_EQ(without(0),
            "all that differ have the disparity 0 px in the model, its least, which is nowhere in the "
            "circuit's: it "
            "never wins");
  EXPECT_EQ(without(13), "none of those known: scattered over the image");
}

// Where some are right, it wins there.
TEST_F(AbsentDisparity, IsNotSaidWhereItWins) {
  EXPECT_EQ(pattern([](const ValuePlace& place, std::uint64_t value) {
              return value != 4095 && value / 16 == 31 && place.row % 4 != 0
                         ? 80 + static_cast<std::uint64_t>(place.row * 7)
                         : value;
            }),
            "none");
}

}  // namespace absent_disparity_test
}  // namespace parallax
