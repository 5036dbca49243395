// SPDX-License-Identifier: Apache-2.0
#include "platform/input/text_file.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <opencv2/core.hpp>

#include "platform/input/number_text.hpp"
#include "platform/input/read_calibration.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax {
namespace text_file_test {

using test::message;

class TextFile : public test::FolderTest {
 protected:
  std::string pack(const std::string& name, const std::string& text, const char* mode = "wb") const {
    const gzFile file = gzopen(path(name).c_str(), mode);
    gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
    gzclose(file);
    return path(name);
  }
};

TEST_F(TextFile, IsUnpackedByItsContent) {
  EXPECT_EQ(read_text_file(write("a.txt", "a\nb")), "a\nb");
  EXPECT_EQ(read_text_file(write("b.gz", "a\nb")), "a\nb") << "the name does not count";
  EXPECT_EQ(read_text_file(write("c.txt", "\xef\xbb\xbfk: v")), "k: v");
  EXPECT_EQ(read_text_file(write("d.txt", "")), "");
  pack("e.gz", "first ");
  EXPECT_EQ(read_text_file(pack("e.gz", "second", "ab")), "first second") << "two members";
  const std::string large(300'000, 'x');
  EXPECT_EQ(read_text_file(pack("f", large)), large);
}

TEST_F(TextFile, DamageIsNamed) {
  const std::string file = pack("a.gz", "some text that is packed");
  const std::string bytes = folder_.read("a.gz");
  const std::string cut = write("b.gz", bytes.substr(0, bytes.size() - 9));
  EXPECT_EQ(message([&] { read_text_file(cut); }), cut + ": damaged gzip file: it ends too early");
  std::string changed = bytes;
  changed[bytes.size() - 6] ^= 1;
  const std::string wrong = write("c.gz", changed);
  EXPECT_EQ(message([&] { read_text_file(wrong); }), wrong + ": damaged gzip file: incorrect data check");
  const std::string bomb = pack("d.gz", std::string(1'000'000, 'x'));
  EXPECT_EQ(message([&] { read_text_file(bomb, 999'999); }), bomb + ": a text of more than 999999 bytes");
  EXPECT_EQ(read_text_file(bomb, 1'000'000).size(), 1'000'000U);
  const std::string plain = write("e.txt", "12345");
  EXPECT_EQ(message([&] { read_text_file(plain, 4); }), plain + ": a text of more than 4 bytes");
}

TEST_F(TextFile, PackedCalibrationsAreRead) {
  const test::SyntheticPair pair;
  const Calibration plain = read_calibration({write("c.yml", pair.text())});
  EXPECT_EQ(read_calibration({pack("c.yml.gz", pair.text())}).P2, plain.P2);
  // As OpenCV itself packs it.
  {
    cv::FileStorage file(path("d.xml.gz"), cv::FileStorage::WRITE);
    file << "image_width" << pair.width << "image_height" << pair.height << "K1" << pair.camera(0) << "D1"
         << pair.coefficients() << "K2" << pair.camera(1) << "D2" << pair.coefficients() << "R"
         << pair.rotation() << "T" << pair.translation();
  }
  EXPECT_LT(cv::norm(read_calibration({path("d.xml.gz")}).P2 - plain.P2), 1e-9);
}

TEST(NumberText, IsWhatItIsAsAWhole) {
  EXPECT_EQ(number_of("1.0e+03"), 1000);
  EXPECT_EQ(number_of(".5"), 0.5);
  EXPECT_EQ(number_of("5."), 5);
  EXPECT_EQ(number_of("-7"), -7);
  EXPECT_EQ(number_of("+7"), 7);
  EXPECT_EQ(number_of("1e-400"), 0);
  for (const char* text : {"", "-", "+", "--1", "+-1", "1x", "1 ", "0x10", "1,5", "abc", "1e", "."}) {
    EXPECT_FALSE(number_of(text)) << text;
  }
  for (const char* text : {"nan", "NaN", ".nan", "-nan", ".NAN"}) {
    ASSERT_TRUE(number_of(text)) << text;
    EXPECT_TRUE(std::isnan(*number_of(text))) << text;
  }
  for (const char* text : {"inf", "-inf", ".inf", "-.Inf", "1e400", "-1e400", "Infinity"}) {
    ASSERT_TRUE(number_of(text)) << text;
    EXPECT_TRUE(std::isinf(*number_of(text))) << text;
  }
}

}  // namespace text_file_test
}  // namespace parallax
