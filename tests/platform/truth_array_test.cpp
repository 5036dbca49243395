// SPDX-License-Identifier: Apache-2.0
// Ground truth in archives of NumPy.
#include "platform/results/truth_array.hpp"

#include <gtest/gtest.h>

#include "platform/results/truth_file.hpp"
#include "tests/platform/error_of.hpp"
#include "tests/platform/python.hpp"
#include "tests/platform/temporary_folder.hpp"
#include "tests/platform/zip_bytes.hpp"

namespace parallax {
namespace truth_array_test {

using Floats = std::vector<float>;

/// 3x2 bytes without sign whose first pixel is `first`, the others 2 to 6.
std::string npy(int first) {
  std::string header = "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3), }\n";
  return std::string("\x93NUMPY\x01", 7) + '\0' + test::little(header.size(), 2) + header +
         static_cast<char>(first) + "\x02\x03\x04\x05\x06";
}

class TruthArray : public testing::Test {
 protected:
  float first_of(const std::string& path) {
    notices_.clear();
    return read_ground_truth({path, "", 1.0}, 3, 2,
                             [this](const std::string& line) { notices_.push_back(line); })
        .disparity.front();
  }
  /// What is said of "t.npz" with this content, without its path.
  std::string complaint(const std::string& bytes, const std::string& array = "") {
    const std::string file = folder_.write("t.npz", bytes);
    std::string line = error_of([&] { first_of(file + array); });
    for (std::size_t at = line.find(file); at != std::string::npos; at = line.find(file))
      line.erase(at, file.size());
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    return line;
  }

  const TemporaryFolder folder_;
  std::vector<std::string> notices_;
};

TEST_F(TruthArray, TheOnlyOneWhateverItsName) {
  EXPECT_EQ(first_of(folder_.write("t.npz", test::zip_of({{"x.npy", npy(7)}}))), 7);
  EXPECT_EQ(first_of(folder_.write("t", test::zip_of({{"x.npy", npy(7)}, {"notes.txt", "hello"}}))), 7)
      << "what is no array does not count";
  EXPECT_TRUE(notices_.empty());
}

TEST_F(TruthArray, TheOneThatIsNamedLikeDisparities) {
  const std::string file = folder_.write(
      "t.npz", test::zip_of({{"depth.npy", npy(7)}, {"disp.npy", npy(8)}, {"mask.npy", npy(9)}}));
  EXPECT_EQ(first_of(file), 8);
  EXPECT_EQ(notices_, (std::vector<std::string>{"ground truth " + file +
                                                ": it holds the arrays depth, disp, mask: disp is taken; " +
                                                file + ":NAME names another"}));
  EXPECT_EQ(first_of(file + ":depth"), 7);
  EXPECT_TRUE(notices_.empty());
  EXPECT_EQ(first_of(folder_.write("u.npz", test::zip_of({{"arr_0.npy", npy(4)}, {"arr_1.npy", npy(5)}}))),
            4);
}

TEST_F(TruthArray, ThatNoNameTells) {
  EXPECT_EQ(complaint(test::zip_of({{"left.npy", npy(7)}, {"right.npy", npy(8)}})),
            ": holds the arrays left, right; name the one that holds disparities: --ground-truth :left");
  EXPECT_EQ(
      complaint(test::zip_of({{"a.npy", npy(7)}, {"disp.npy", npy(8)}, {"disparity.npy", npy(8)}})),
      ": holds the arrays a, disp, disparity; name the one that holds disparities: --ground-truth :disp");
  EXPECT_EQ(complaint(test::zip_of({{"a.npy", npy(7)}, {"b.npy", npy(8)}}), ":c"),
            ": holds no array c, but a, b");
  EXPECT_EQ(complaint(test::zip_of({{"a.txt", "hello"}})),
            ": an archive without arrays, which numpy.savez names *.npy");
  EXPECT_EQ(complaint(test::zip_of({})), ": an archive without arrays, which numpy.savez names *.npy");
  EXPECT_EQ(complaint(npy(7), ":disp"), ": no archive (.npz) that could hold an array disp");
}

TEST_F(TruthArray, PathsThatHoldAColonAreFilesWhenTheyExist) {
  const std::string file = folder_.write("a:b.npz", test::zip_of({{"x.npy", npy(7)}, {"y.npy", npy(8)}}));
  EXPECT_EQ(first_of(file + ":y"), 8);
  EXPECT_EQ(truth_path(file).file, file);
  EXPECT_EQ(truth_path(file + ":y").array, "y");
  EXPECT_EQ(truth_path("none.npz:y").file, "none.npz:y") << "which does not exist, and is said not to";
}

TEST_F(TruthArray, OfNumPyItself) {
  if (!test::python_has("numpy")) GTEST_SKIP() << "no python3-numpy";
  // Pixel (x, y) is 10 y + x + 0.25.
  test::python(folder_,
               "import numpy as np\n"
               "d = np.array([[10 * y + x + 0.25 for x in range(3)] for y in range(2)], np.float32)\n"
               "np.savez('plain.npz', disparity=d, left=np.zeros((2, 3)))\n"
               "np.savez_compressed('packed.npz', d, np.zeros((500, 400)))\n");
  const Floats expected{0.25, 1.25, 2.25, 10.25, 11.25, 12.25};
  EXPECT_EQ(read_ground_truth({folder_ / "plain.npz", "", 1.0}, 3, 2, {}).disparity, expected);
  EXPECT_EQ(read_ground_truth({folder_ / "packed.npz", "", 1.0}, 3, 2, {}).disparity, expected);
  EXPECT_EQ(error_of([&] {
              read_ground_truth({folder_ / "packed.npz:arr_1", "", 1.0}, 3, 2, {});
            }),
            folder_ / "packed.npz:arr_1" + ": the ground truth is 400x500, the images are 3x2");
}

TEST_F(TruthArray, DamageAnywhereIsOneLineOrAnotherTruth) {
  const std::string whole = test::zip_of({{"x.npy", npy(7)}, {"disp.npy", npy(8)}});
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int flip : {0x01, 0x80, 0xFF}) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ flip);
      complaint(damaged);
      complaint(damaged, ":x");
    }
    EXPECT_NE(complaint(whole.substr(0, at)), "(no error)") << at;
  }
  std::string damaged = whole;
  damaged[whole.find(npy(8)) + npy(8).size() - 1] = 9;
  EXPECT_EQ(complaint(damaged), ": disp.npy: is damaged: its checksum is another");
  EXPECT_EQ(complaint(whole.substr(0, whole.size() - 1)),
            ": a damaged archive: it has no directory at its end");
}

}  // namespace truth_array_test
}  // namespace parallax
