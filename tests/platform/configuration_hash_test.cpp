// SPDX-License-Identifier: Apache-2.0
#include "platform/config/configuration_hash.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "platform/config/config_writer.hpp"
#include "platform/config/configuration.hpp"
#include "tests/paths.hpp"
#include "tests/platform/temporary_folder.hpp"

namespace parallax {
namespace configuration_hash_test {

const std::filesystem::path kShipped = test::source_path("platform/presets");

std::string hash(const std::string& preset, const std::vector<std::string>& assignments = {}) {
  return configuration_hash(load_configuration({preset, assignments, {}}, {kShipped}).machine);
}

TEST(ConfigurationHash, IsThatOfTheValuesHoweverTheyWereGiven) {
  const std::string usual = hash("scenescan-pro");
  EXPECT_EQ(usual.size(), 16U);
  EXPECT_EQ(usual.find_first_not_of("0123456789abcdef"), std::string::npos) << usual;
  const std::string core = "clocks.core_hz=125000000", range = "matching.iterations=8";
  const std::string other = hash("scenescan-pro", {core, range});
  EXPECT_NE(other, usual);
  EXPECT_EQ(hash("scenescan-pro", {range, core}), other);
  EXPECT_EQ(hash("scenescan-pro", {"clocks.core_hz=1", range, "clocks.core_hz=1.25e8"}), other);
  EXPECT_EQ(configuration_hash(load_configuration({"scenescan-pro", {core}, 256}, {kShipped}).machine),
            other);
  EXPECT_EQ(hash("scenescan-pro", {"matching.paths=n,w"}),
            hash("scenescan-pro", {"matching.paths=\"w, n\""}));
  // A value that is the preset's own.
  EXPECT_EQ(hash("scenescan-pro", {"clocks.core_hz=188000000"}), usual);
}

TEST(ConfigurationHash, OfAFileWithTheSameValuesIsTheSame) {
  const TemporaryFolder folder;
  for (const char* preset : {"scenescan-pro", "xfopencv-sgbm", "core-alone"}) {
    const Configuration configuration = load_configuration({preset, {}, {}}, {kShipped});
    std::ofstream(folder / "same.toml") << to_toml(configuration, false);
    EXPECT_EQ(hash(folder / "same.toml"), configuration_hash(configuration.machine)) << preset;
  }
}

// Another value that the key can hold.
ConfigValue other_value(const Key& key) {
  const ConfigValue value = key.get();
  switch (key.type) {
    case KeyType::kBoolean:
      return !std::get<bool>(value);
    case KeyType::kInteger: {
      const auto held = std::get<std::int64_t>(value);
      return held < key.integers.most ? held + 1 : held - 1;
    }
    case KeyType::kReal: {
      const auto held = std::get<double>(value);
      return held == key.reals.most ? key.reals.least : (held + key.reals.most) / 2;
    }
    case KeyType::kChoice:
    case KeyType::kNameSet:
      return *std::find_if(key.names.begin(), key.names.end(),
                           [&](const std::string& name) { return ConfigValue(name) != value; });
    case KeyType::kText:
      return std::get<std::string>(value) + "x";
  }
  return value;
}

TEST(ConfigurationHash, IsAnotherWhenAnyKeyIsAnother) {
  MachineConfig config = load_configuration({"scenescan-pro", {}, {}}, {kShipped}).machine;
  Schema schema;
  describe(schema, config);
  std::set<std::string> hashes{configuration_hash(config)};
  for (const Key& key : schema.keys()) {
    const ConfigValue before = key.get();
    key.set(other_value(key));
    ASSERT_NE(key.get(), before) << key.path;
    EXPECT_TRUE(hashes.insert(configuration_hash(config)).second) << key.path;
    key.set(before);
  }
  EXPECT_EQ(hashes.count(configuration_hash(config)), 1U);
  EXPECT_EQ(hashes.size(), schema.keys().size() + 1);
}

}  // namespace configuration_hash_test
}  // namespace parallax
