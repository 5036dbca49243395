// SPDX-License-Identifier: Apache-2.0
// The host compares what arrives with what left the pipeline.
#include "platform/machine/host.hpp"

#include <gtest/gtest.h>

#include <string>
#include <systemc>
#include <vector>

namespace parallax::test {
namespace host_test {

constexpr int kHeight = 2;

// Two tiles of 4 columns, of which 3 and 3 are kept.
TilePlan two_tiles() {
  TilePlan plan;
  plan.width = 4;
  plan.tiles.resize(2);
  plan.tiles[0].begin = 0;
  plan.tiles[0].keep_begin = 0;
  plan.tiles[0].keep_end = 3;
  plan.tiles[1].begin = 2;
  plan.tiles[1].keep_begin = 3;
  plan.tiles[1].keep_end = 6;
  return plan;
}

Disparity disparity(std::size_t pixel) {
  Disparity made;
  made.value = static_cast<std::uint16_t>(100 + pixel);
  return made;
}

class HostCheck : public ::testing::Test {
 protected:
  HostCheck() {
    input_.width = 6;
    input_.height = kHeight;
    input_.frames = 1;
    input_.deliver = [this](const FrameResult& result) { results_.push_back(result); };
    input_.finished = [this] { finished_ = true; };
    for (const Tile& tile : tiles_.tiles) {
      for (std::size_t y = 0; y < kHeight; ++y) {
        std::vector<Disparity> row;
        for (int x = 0; x < tiles_.width; ++x)
          row.push_back(disparity(y * 6 + static_cast<std::size_t>(tile.begin + x)));
        host_.expect(row.data());
      }
    }
    OutputPacking packing(6, OutputLeft::kGrey);
    for (std::size_t y = 0; y < kHeight; ++y) {
      std::vector<Gray> left(6, static_cast<Gray>(y));
      std::vector<Disparity> row;
      for (std::size_t x = 0; x < 6; ++x) row.push_back(disparity(y * 6 + x));
      const RowSink<std::uint8_t> take = [this](const std::uint8_t* bytes) {
        bytes_.insert(bytes_.end(), bytes, bytes + OutputPacking::row_bytes(6, OutputLeft::kGrey));
      };
      packing.push(left.data(), row.data(), take);
    }
  }

  MachineInput input_;
  const TilePlan tiles_ = two_tiles();
  bool settled_ = false;
  Host host_{input_, tiles_, OutputLeft::kGrey, [this] { return settled_; }};
  std::vector<std::uint8_t> bytes_;
  std::vector<FrameResult> results_;
  bool finished_ = false;
};

TEST_F(HostCheck, DeliversTheKeptColumnsOfAllTiles) {
  host_.receive(0, bytes_);
  ASSERT_EQ(results_.size(), 1u);
  ASSERT_EQ(results_[0].disparities.size(), 12u);
  for (std::size_t pixel = 0; pixel < 12; ++pixel) {
    EXPECT_EQ(results_[0].disparities[pixel].value, 100 + pixel);
    EXPECT_EQ(results_[0].left[pixel], pixel / 6);
  }
  EXPECT_TRUE(finished_);
  EXPECT_EQ(host_.frames(), 1);
}

TEST_F(HostCheck, FindsAnotherDisparity) {
  bytes_.at(5 + 2) ^= 1;  // the lowest bit of the disparity at (2, 0), in the second pair of 5 bytes
  try {
    host_.receive(0, bytes_);
    FAIL() << "nothing was reported";
  } catch (const sc_core::sc_report& report) {
    EXPECT_STREQ(report.get_msg_type(), "/parallax/machine/values");
    EXPECT_STREQ(report.get_msg(), "frame 0: the host's disparity at (2, 0) is not the pipeline's");
  }
}

TEST_F(HostCheck, AFrameWithoutValuesIsDeliveredEmpty) {
  host_.receive(0, {});
  ASSERT_EQ(results_.size(), 1u);
  EXPECT_TRUE(results_[0].disparities.empty());
  EXPECT_TRUE(finished_);
}

TEST_F(HostCheck, TheRunEndsWhenItIsSettledAndHasTheLeast) {
  input_.frames = 5;
  input_.least_frames = 2;
  settled_ = true;
  host_.receive(0, {});
  EXPECT_FALSE(host_.done());
  settled_ = false;
  host_.receive(1, {});
  EXPECT_FALSE(host_.done());
  settled_ = true;
  host_.receive(2, {});
  EXPECT_TRUE(host_.done());
  EXPECT_TRUE(finished_);
  host_.receive(3, {});
  EXPECT_EQ(host_.frames(), 3);
  EXPECT_EQ(results_.size(), 3u);
}

}  // namespace host_test
}  // namespace parallax::test
