// SPDX-License-Identifier: Apache-2.0
#include "platform/registers/run_time_parameters.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "platform/config/schema.hpp"
#include "platform/registers/algorithm_parameters.hpp"
#include "platform/registers/register_map.hpp"
#include "platform/registers/register_word.hpp"

namespace parallax::test {
namespace run_time_parameters_test {

/// What a row's key is bound to, with its range; a boolean is 0 or 1.
struct BoundKey {
  MachineConfig config;
  Schema schema;
  const Key* key = nullptr;

  explicit BoundKey(const RunTimeParameter& p) {
    describe(schema, config);
    key = schema.find(p.key);
  }
  IntegerRange range() const { return key->type == KeyType::kBoolean ? IntegerRange{0, 1} : key->integers; }
  ConfigValue value_of(int value) const {
    if (key->type == KeyType::kBoolean) return ConfigValue(value != 0);
    return ConfigValue(std::int64_t{value});
  }
};

TEST(RunTimeParameters, MemberAndKeyAreTheSameField) {
  for (const RunTimeParameter& p : run_time_parameters()) {
    BoundKey bound(p);
    ASSERT_NE(bound.key, nullptr) << p.key;
    for (const std::int64_t value : {bound.range().least, bound.range().most}) {
      p.member.set(bound.config, static_cast<int>(value));
      EXPECT_EQ(bound.key->get(), bound.value_of(static_cast<int>(value))) << p.key;
      EXPECT_EQ(p.member.get(bound.config), value) << p.key;
    }
  }
}

TEST(RunTimeParameters, AFieldHoldsAllThatItsKeyAllowsAndARuleMeetsTheRest) {
  for (const RunTimeParameter& p : run_time_parameters()) {
    const BoundKey bound(p);
    const std::uint32_t most = (1U << p.width) - 1;
    for (const std::int64_t value : {bound.range().least, bound.range().most}) {
      const std::uint32_t bits = p.encode(static_cast<int>(value));
      EXPECT_LE(bits, most) << p.key;
      EXPECT_EQ(p.decode(bits), value) << p.key;
    }
    const bool exact = p.decode(0) == bound.range().least && p.decode(most) == bound.range().most;
    EXPECT_TRUE(exact || p.rule != nullptr)
        << p.key << ": its field holds values that the key does not allow; a rule has to refuse them";
  }
}

TEST(RunTimeParameters, ARowIsAFieldOfTheMapWithItsKeyInTheText) {
  for (const RunTimeParameter& p : run_time_parameters()) {
    const Register& reg = find_register("stereo", p.reg).description;
    EXPECT_EQ(compose(reg, {{p.field, 1}}), 1U << p.low) << p.key;
    EXPECT_NE(registers_as_text().find(p.key), std::string::npos) << p.key;
  }
}

TEST(RunTimeParameters, EveryRuleHasItsErrorBit) {
  const Register& errors = find_register("stereo", "errors").description;
  for (const RunTimeParameter& p : run_time_parameters()) {
    if (p.rule == nullptr) continue;
    EXPECT_EQ(compose(errors, {{p.rule->error, 1}}), 1U << p.rule->bit) << p.key;
  }
}

TEST(RunTimeParameters, NoTwoRowsStandForTheSame) {
  std::set<std::string> keys;
  std::set<const char*> registers;
  const char* last = nullptr;
  for (const RunTimeParameter& p : run_time_parameters()) {
    EXPECT_TRUE(keys.insert(p.key).second) << p.key;
    if (p.reg != last) {
      EXPECT_TRUE(registers.insert(p.reg).second) << "the rows of " << p.reg << " stand apart";
    }
    last = p.reg;
  }
}

TEST(RunTimeParameters, AConfigurationsParametersMakeTheSameConfiguration) {
  MachineConfig config;
  config.matching.p2 = 77;
  config.texture.enabled = !config.texture.enabled;
  config.uniqueness.factor = 300;
  const AlgorithmParameters parameters = algorithm_parameters(config);
  EXPECT_FALSE(parameters == algorithm_parameters(MachineConfig()));
  const MachineConfig copy = with_parameters(MachineConfig(), parameters);
  EXPECT_EQ(copy.matching.p2, 77);
  EXPECT_EQ(copy.texture.enabled, config.texture.enabled);
  EXPECT_EQ(copy.uniqueness.factor, 300);
  EXPECT_TRUE(algorithm_parameters(copy) == parameters);
  EXPECT_THROW(with_parameters(config, AlgorithmParameters{}), std::out_of_range);
}

TEST(RunTimeParameters, TheRemarkNamesTheRegister) {
  EXPECT_EQ(run_time_remark("matching.p1"),
            "May change from frame to frame: register stereo.algorithm_parameters_1, field p1.");
  EXPECT_EQ(run_time_remark("matching.iterations"), "");
  EXPECT_EQ(run_time_remark("image.width"), "");
}

TEST(RegisterWord, AFieldThatDoesNotExistIsAnError) {
  const Register& reg = find_register("stereo", "algorithm_parameters_1").description;
  EXPECT_EQ(compose(reg, {{"p1", 0x123}, {"p2", 4}}), 0x423u);
  try {
    compose(reg, {{"p1", 1}, {"p3", 1}});
    FAIL();
  } catch (const std::logic_error& error) {
    EXPECT_STREQ(error.what(), "no field p3 in register algorithm_parameters_1");
  }
}

TEST(RegisterWord, ARegisterThatDoesNotExistIsAnError) {
  EXPECT_EQ(find_register("stereo", "errors").address, 0x128u);
  EXPECT_THROW(find_register("stereo", "status"), std::logic_error);
  EXPECT_THROW(find_register("none", "status"), std::logic_error);
}

}  // namespace run_time_parameters_test
}  // namespace parallax::test
