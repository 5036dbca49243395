// SPDX-License-Identifier: Apache-2.0
#include "platform/estimate/device_file.hpp"

#include <gtest/gtest.h>

#include "platform/config/preset.hpp"
#include "platform/config/preset_file.hpp"
#include "tests/paths.hpp"
#include "tests/platform/error_of.hpp"
#include "tests/platform/temporary_folder.hpp"

namespace parallax::test {
namespace device_file_test {

namespace fs = std::filesystem;

std::vector<fs::path> shipped() { return {source_path("platform/presets")}; }

class DeviceFiles : public testing::Test {
 protected:
  // The error of a file with this content, from the file's name on.
  std::string error_in(const std::string& content) {
    const std::string path = folder_.write("own.toml", content);
    const std::string line = error_of([&] { load_device(path, shipped()); });
    const std::size_t at = line.find("own.toml");
    return at == std::string::npos ? line : line.substr(at);
  }
  const std::string zynq_ = "inherits = \"" + source_path("platform/presets/devices/zynq-7020.toml") + "\"\n";
  TemporaryFolder folder_;
};

TEST_F(DeviceFiles, AllThatAreShippedHaveTotalsTagsAndSources) {
  const std::vector<std::string> names = device_names(shipped());
  EXPECT_EQ(names, (std::vector<std::string>{"cyclone-v-a6", "ecp5-85", "zu9eg", "zynq-7020", "zynq-7030",
                                             "zynq-7045"}));
  for (const std::string& name : names) {
    const DeviceTotals totals = load_device(name, shipped()).totals;
    for (const std::int64_t total :
         {totals.luts, totals.memory_luts, totals.registers, totals.block_rams, totals.dsps})
      EXPECT_GT(total, 0) << name;
    EXPECT_LT(totals.memory_luts, totals.luts) << name;
  }
  for (const auto& entry : fs::recursive_directory_iterator(source_path("platform/presets/devices"))) {
    if (entry.path().extension() != ".toml") continue;
    for (const auto& [key, value] : read_preset_file(entry.path()).values) {
      EXPECT_TRUE(value.tag.has_value()) << entry.path() << " " << key;
      EXPECT_FALSE(value.source.value_or("").empty()) << entry.path() << " " << key;
      const bool rule = key.rfind("circuit.rule.", 0) == 0;
      EXPECT_EQ(value.tag == Tag::kFitted, key.rfind("circuit.", 0) == 0 && !rule) << key;
    }
  }
}

TEST_F(DeviceFiles, OneOfTheUsersOwnMayStateItsTotalsAlone) {
  const std::string path = folder_.write("own.toml", zynq_ + "[device]\nblock_rams = 1000\n");
  const DeviceFile device = load_device(path, shipped());
  EXPECT_EQ(device.totals.block_rams, 1000);
  EXPECT_EQ(device.totals.luts, 53200);
  EXPECT_EQ(device.block_ram.shapes.size(), 6U);
}

TEST_F(DeviceFiles, ANameThatThereIsNotIsAnsweredWithTheNearest) {
  const std::string line = error_of([] { load_device("zynq-7021", shipped()); });
  EXPECT_NE(line.find("device"), std::string::npos) << line;
  EXPECT_NE(line.find("zynq-7020"), std::string::npos) << line;
}

TEST_F(DeviceFiles, RefusesWhatIsWrongInAFile) {
  EXPECT_EQ(error_in(zynq_ + "[device]\nlutz = 3\n"),
            "own.toml:3: unknown key device.lutz; the nearest is device.luts");
  EXPECT_EQ(error_in(zynq_ + "[device]\nluts = -3\n").rfind("own.toml:3: device.luts = -3", 0), 0U);
  for (const char* shapes :
       {"18", "18x", "x18", "2048x9,", "2048x9 1024x18", "0x9", "9x0", "99999999x1", "8x5000"}) {
    EXPECT_EQ(error_in(zynq_ + "[lut_ram]\nshapes = \"" + shapes + "\"\n"),
              "lut_ram.shapes = \"" + std::string(shapes) +
                  "\": expected shapes as words x bits, as in \"2048x9, 1024x18\", words up to 16777216 and "
                  "bits up "
                  "to 4096, or \"none\"");
  }
  EXPECT_EQ(error_in(zynq_ + "[device]\nluts = 0\nregisters = 0\nblock_rams = 0\ndsps = 0\n"),
            "own.toml states no total; set device.luts, device.block_rams, device.registers or device.dsps");
  EXPECT_EQ(error_in("[device]\nluts = 3\n"),
            "own.toml does not state family.name, nor does what it inherits; with inherits = \"zynq-7020\" "
            "it has all "
            "keys");
}

}  // namespace device_file_test
}  // namespace parallax::test
