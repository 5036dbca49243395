// SPDX-License-Identifier: Apache-2.0
// Images that a program hands over, as the Python module does.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "error_line.hpp"
#include "platform/images/image_codecs.hpp"
#include "platform/input/image_input.hpp"
#include "platform/results/output_file.hpp"
#include "temporary_folder.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace images_in_memory_test {

cv::Mat random_image(int width, int height, int type, int highest, std::uint64_t seed) {
  cv::Mat image(height, width, type);
  cv::RNG(seed).fill(image, cv::RNG::UNIFORM, 0, highest + 1);
  return image;
}

cv::Mat grey(int width, int height) { return random_image(width, height, CV_8UC1, 255, 1); }

TEST(ImagesInMemory, AreTakenAsFilesAre) {
  const TemporaryFolder folder;
  const std::vector<StereoImages> images{
      {random_image(20, 10, CV_16UC1, 1023, 1), grey(20, 10)},
      {random_image(20, 10, CV_8UC3, 255, 2), random_image(20, 10, CV_8UC4, 255, 3)}};
  std::vector<ImagePair> files;
  for (std::size_t i = 0; i < images.size(); ++i) {
    files.push_back({folder / (std::to_string(i) + "l.png"), folder / (std::to_string(i) + "r.png")});
    write_file(files[i].left, encode_image(".png", images[i].left));
    write_file(files[i].right, encode_image(".png", images[i].right));
  }
  ImageInput in_memory(pairs_in_memory(images), {}, {}), in_files(files, {}, {});
  ASSERT_EQ(in_memory.frames(), images.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    EXPECT_EQ(cv::norm(in_memory.load(i).left, in_files.load(i).left, cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(in_memory.load(i).right, in_files.load(i).right, cv::NORM_INF), 0);
  }
}

TEST(ImagesInMemory, HaveNames) {
  const auto refused = [](const std::vector<StereoImages>& images) {
    return error_line<UserError>([&] {
      ImageInput input(pairs_in_memory(images), {{64, 64}, {}, false}, {});
      for (std::size_t i = 0; i < images.size(); ++i) input.load(i);
    });
  };
  EXPECT_EQ(refused({{grey(20, 10), grey(20, 11)}}),
            "the left image left is 20x10, the right image right is 20x11; both must have one size");
  EXPECT_EQ(refused({{grey(20, 10), grey(20, 10)}, {grey(65, 10), grey(20, 10)}}),
            "image left[1] is 65x10, larger than the largest size 64x64");
}

}  // namespace images_in_memory_test
}  // namespace parallax
