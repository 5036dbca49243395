// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/map_command.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

#include "platform/commands/command_context.hpp"
#include "platform/images/image_codecs.hpp"
#include "platform/input/map_info.hpp"
#include "platform/input/map_storage.hpp"
#include "platform/input/raw_map_file.hpp"
#include "platform/results/output_file.hpp"
#include "tests/platform/test_calibrations.hpp"

namespace parallax {
namespace map_command_test {

using test::message;
using test::SyntheticPair;

class MapCommand : public test::FolderTest {
 protected:
  // What the command prints.
  static std::string run(std::vector<std::string> arguments) {
    CLI::App app;
    std::ostringstream out;
    CommandContext context{out, out, CommandLine(0, nullptr)};
    add_map_command(app, context);
    std::reverse(arguments.begin(), arguments.end());
    app.parse(arguments);
    EXPECT_EQ(context.action(), 0);
    return out.str();
  }

  static std::string error(const std::vector<std::string>& arguments) {
    return message([&] { run(arguments); });
  }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
  }
};

TEST_F(MapCommand, EncodesInspectsDecodesAndEncodesAgain) {
  SyntheticPair pair;
  pair.width = 160;
  pair.height = 120;
  pair.focal = 125;
  const std::string calibration = write("c.yml", pair.text());
  const std::string out = run({"map", "encode", "--calibration", calibration, "--fit", "-o", path("a.map")});
  EXPECT_EQ(out.find("fit: zoom "), 0U) << out;
  EXPECT_NE(out.find("160x120 px"), std::string::npos) << out;
  const EncodedMap map = read_map_file(path("a.map"));
  for (const char* format : {"raw.yml", "raw.xml", "raw.json"}) {
    EXPECT_EQ(run({"map", "decode", path("a.map"), "-o", path(format)}), path(format) + "\n");
    run({"map", "encode", "--maps", path(format), "-o", path("b.map")});
    EXPECT_EQ(read_map_file(path("b.map")).bytes, map.bytes) << format;
  }
  run({"map", "decode", path("a.map"), "-o", path("raw.tiff")});
  run({"map", "encode", "-o", path("b.map"), "--maps", path("raw_left_x.tiff"), path("raw_left_y.tiff"),
       path("raw_right_x.tiff"), path("raw_right_y.tiff")});
  EXPECT_EQ(read_map_file(path("b.map")).bytes, map.bytes);

  const auto json = nlohmann::json::parse(run({"map", "info", path("a.map"), "--json"}));
  EXPECT_EQ(json["width_px"], 160);
  EXPECT_EQ(json["stream_bytes"], map.bytes.size());
  EXPECT_EQ(json["file_bytes"], std::filesystem::file_size(path("a.map")));
  EXPECT_LE(json["bytes_per_pixel_and_image"].get<double>(), 1.0);
  EXPECT_LE(json["largest_offset_px"]["left"]["x"].get<double>(), 39.0);
  const auto rows = json["row_bytes"]["rows"].get<std::vector<std::uint32_t>>();
  EXPECT_EQ(rows, map.row_bytes);
  EXPECT_EQ(std::accumulate(rows.begin(), rows.end(), std::size_t{0}), map.bytes.size());
  EXPECT_EQ(json["row_bytes"]["worst_case"], 980);
}

TEST_F(MapCommand, InfoPrintsAPage) {
  run({"map", "encode", "--identity", "64x3", "-o", path("i.map")});
  EXPECT_EQ(run({"map", "info", path("i.map"), "--rows"}),
            "size                    64x3 px\n"
            "window                  79 px (-39..+39), 5 fraction bits\n"
            "stream                  24 bytes, 0.0625 bytes per pixel and image (at most 3.06)\n"
            "file                    68 bytes\n"
            "largest offsets, left   0 px horizontally, 0 px vertically\n"
            "largest offsets, right  0 px horizontally, 0 px vertically\n"
            "bytes per row           8 least, 8 mean, 8 largest, 392 worst case\n"
            "row     0  8 bytes\n"
            "row     1  8 bytes\n"
            "row     2  8 bytes\n");
}

TEST_F(MapCommand, NothingIsWrittenWhenTheOffsetsDoNotFit) {
  const std::string calibration = write("c.yml", test::fisheye_pair().text());
  const std::string line = error({"map", "encode", "--calibration", calibration, "-o", path("a.map")});
  EXPECT_EQ(line.find(calibration + ": left image: pixel ("), 0U) << line;
  EXPECT_NE(line.find("or --fit: zoom "), std::string::npos) << line;
  EXPECT_EQ(files(), 1U);
}

TEST_F(MapCommand, WrongSizesAndRangesAreNamed) {
  const std::string calibration = write("c.yml", SyntheticPair().text());
  const std::string out = path("a.map");
  EXPECT_EQ(error({"map", "encode", "--calibration", calibration, "--size", "752x480", "-o", out}),
            calibration + ": the calibration is for images of 640x480, these have 752x480");
  EXPECT_EQ(error({"map", "encode", "--identity", "640", "-o", out}),
            "--identity: \"640\" is not a size such as 640x480");
  EXPECT_EQ(error({"map", "encode", "--identity", "0x4", "-o", out}),
            "--identity: \"0x4\" is not a size such as 640x480");
  EXPECT_EQ(error({"map", "encode", "--identity", "64x4", "--window", "80", "-o", out}),
            "rectification.window: 80 is not an odd number in 1..2047");
  EXPECT_EQ(error({"map", "encode", "--identity", "64x4", "--fraction-bits", "9", "-o", out}),
            "rectification.fraction_bits: 9 is outside 0..8");
  EXPECT_THROW(run({"map", "encode", "-o", out}), CLI::ParseError);
  EXPECT_THROW(run({"map", "encode", "--identity", "4x4", "--calibration", calibration, "-o", out}),
               CLI::ParseError);
  EXPECT_EQ(files(), 1U);
}

TEST_F(MapCommand, BadMapsAreNamed) {
  run({"map", "encode", "--identity", "64x4", "-o", path("a.map")});
  std::filesystem::resize_file(path("a.map"), 50);
  EXPECT_EQ(error({"map", "info", path("a.map")}),
            path("a.map") + ": truncated rectification map: it ends at byte 50 of 80");
  // A map whose checksum is right and whose row is not.
  EncodedMap wrong = encode(identity_map(64, 4));
  wrong.bytes[8] = 0x0D;
  write_map_file(path("b.map"), wrong);
  EXPECT_EQ(
      error({"map", "decode", path("b.map"), "-o", path("b.yml")}),
      path("b.map") +
          ": rectification map: row 1, pixel 0 (byte 0 of the row): a residual is wider than an offset");
  EXPECT_EQ(error({"map", "info", path("none.map")}),
            path("none.map") + ": cannot read: No such file or directory");
  EXPECT_EQ(files(), 2U);
}

TEST_F(MapCommand, BadRawMapsAreNamed) {
  const std::string head = "%YAML:1.0\n---\n";
  const auto matrix = [](const char* name, const char* shape) {
    return std::string(name) + ": !!opencv-matrix\n" + shape;
  };
  const char* const kTwo = "   rows: 1\n   cols: 2\n   dt: f\n   data: [ 0., 1. ]\n";
  const char* const kOne = "   rows: 1\n   cols: 1\n   dt: d\n   data: [ 0. ]\n";
  const char* const kBytes = "   rows: 1\n   cols: 1\n   dt: u\n   data: [ 0 ]\n";
  const auto read = [&](const std::string& text) {
    const std::string file = write("m.yml", text);
    const std::string line = message([&] { read_raw_maps({file}); });
    return line.substr(std::min(line.size(), file.size()));
  };
  EXPECT_EQ(read(head + matrix("left_x", kTwo)), ": matrix left_y is missing");
  EXPECT_EQ(read(head + "left_x: 5\n"), ": left_x is not a matrix");
  EXPECT_EQ(read(head + matrix("left_x", kBytes)), ": left_x: a map has one channel of 32-bit float");
  EXPECT_EQ(read(head + matrix("left_x", kTwo) + matrix("left_y", kOne) + matrix("right_x", kTwo) +
                 matrix("right_y", kTwo)),
            ": left_y has 1x1 pixels, left_x has 2x1");
  EXPECT_EQ(read("hello"),
            ": not an OpenCV YAML, XML or JSON file: the first line of OpenCV's YAML is %YAML:1.0, XML "
            "begins with <?xml, "
            "JSON with {");
  EXPECT_EQ(message([&] {
              read_raw_maps({"a", "b"});
            }),
            "raw maps: 2 files; one with four matrices, or four images (left x, left y, right x, right y) "
            "expected");
  const std::string bad = write("x.tiff", "hello");
  EXPECT_EQ(message([&] {
              read_raw_maps({bad, bad, bad, bad});
            }),
            "cannot read map " + bad + ": it is damaged, or not a PNG, JPEG, TIFF, BMP, PNM or WebP file");
  write_file(path("gray.png"), encode_image(".png", cv::Mat(2, 2, CV_8UC1, cv::Scalar(1))));
  EXPECT_EQ(message([&] {
              read_raw_maps({path("gray.png"), bad, bad, bad});
            }),
            path("gray.png") + ": a map has one channel of 32-bit float");
  EXPECT_EQ(message([&] { write_raw_maps(path("a.bmp"), raw_maps(identity_map(4, 4))); }),
            path("a.bmp") + ": raw maps are written as .yml, .yaml, .xml, .json, .tif or .tiff");
}

}  // namespace map_command_test
}  // namespace parallax
