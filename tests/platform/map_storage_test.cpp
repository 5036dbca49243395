// SPDX-License-Identifier: Apache-2.0
#include "platform/input/map_storage.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/modules/random_maps.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax {
namespace map_storage_test {

using test::message;

class MapStorage : public test::FolderTest {
 protected:
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
  }
};

TEST_F(MapStorage, ReadsWhatItWrote) {
  const EncodedMap map = encode(test::noise_map(37, 11, {41, 3}, 5));
  write_map_file(path("a.map"), map);
  EXPECT_EQ(files(), 1U);
  const EncodedMap read = read_map_file(path("a.map"));
  EXPECT_EQ(read.width, 37);
  EXPECT_EQ(read.height, 11);
  EXPECT_TRUE(read.range == map.range);
  EXPECT_EQ(read.bytes, map.bytes);
  EXPECT_EQ(read.row_bytes, map.row_bytes);
}

TEST_F(MapStorage, UnreadableAndUnwritableNamesTheFile) {
  EXPECT_EQ(message([&] { read_map_file(path("none.map")); }),
            path("none.map") + ": cannot read: No such file or directory");
  const EncodedMap map = encode(identity_map(4, 4));
  EXPECT_EQ(message([&] { write_map_file(path("no/such/folder/a.map"), map); }),
            "cannot write " + path("no/such/folder/a.map") + ": No such file or directory");
  EXPECT_EQ(message([&] { write_map_file(folder_.path().string(), map); }),
            "cannot write " + folder_.path().string() + ": Is a directory");
  EXPECT_NE(message([&] { read_map_file(folder_.path().string()); }), "");
  EXPECT_EQ(files(), 0U);
}

}  // namespace map_storage_test
}  // namespace parallax
