// SPDX-License-Identifier: Apache-2.0
#include "platform/config/schema.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "platform/config/nearest_name.hpp"
#include "tests/platform/error_of.hpp"

namespace parallax {
namespace schema_test {

enum class Shape { kRound, kSquare };

struct Fields {
  int count = 3;
  std::uint8_t narrow = 7;
  double ratio = 0.5;
  bool enabled = true;
  Shape shape = Shape::kRound;
  unsigned paths = 3;
};

class SchemaTest : public ::testing::Test {
 protected:
  SchemaTest() {
    schema_.integer("part.count", fields_.count, {-5, 10}, "pieces", "How many.", stated("paper"));
    schema_.integer("part.narrow", fields_.narrow, {0, 255}, "", "A byte.", chosen("ours"));
    schema_.real("part.ratio", fields_.ratio, {0.0, 1.5}, "", "A share.", inferred("a picture"));
    schema_.boolean("part.enabled", fields_.enabled, "Whether.", stated("paper"));
    schema_.choice("other.part.shape", fields_.shape, {{"round", Shape::kRound}, {"square", Shape::kSquare}},
                   "Its shape.", chosen("ours"));
    schema_.name_set("part.paths", fields_.paths, {{"w", 1}, {"n", 2}, {"e", 4}}, "Paths.", chosen("ours"));
  }

  std::string set(const std::string& key, std::variant<ConfigValue, NotAValue> value) {
    return error_of([&] { schema_.apply({{key, RawValue{value, {}, {}, "my.toml:3"}}}); });
  }

  Fields fields_;
  Schema schema_;
};

const std::string kFine = "(no error)";

TEST_F(SchemaTest, SetsFieldsOfEveryType) {
  EXPECT_EQ(set("part.count", ConfigValue(std::int64_t{-5})), kFine);
  EXPECT_EQ(set("part.narrow", ConfigValue(std::int64_t{255})), kFine);
  EXPECT_EQ(set("part.ratio", ConfigValue(1.5)), kFine);
  EXPECT_EQ(set("part.enabled", ConfigValue(false)), kFine);
  EXPECT_EQ(set("other.part.shape", ConfigValue(std::string("square"))), kFine);
  EXPECT_EQ(set("part.paths", ConfigValue(std::string("e,w"))), kFine);
  EXPECT_EQ(fields_.count, -5);
  EXPECT_EQ(fields_.narrow, 255);
  EXPECT_EQ(fields_.ratio, 1.5);
  EXPECT_FALSE(fields_.enabled);
  EXPECT_EQ(fields_.shape, Shape::kSquare);
  EXPECT_EQ(fields_.paths, 5U);
  EXPECT_EQ(std::get<std::string>(schema_.find("part.paths")->get()), "w, e");
}

TEST_F(SchemaTest, TakesWholeRealsAsIntegersAndIntegersAsReals) {
  EXPECT_EQ(set("part.count", ConfigValue(1e1)), kFine);
  EXPECT_EQ(fields_.count, 10);
  EXPECT_EQ(set("part.ratio", ConfigValue(std::int64_t{1})), kFine);
  EXPECT_EQ(fields_.ratio, 1.0);
  EXPECT_EQ(set("part.count", ConfigValue(2.5)),
            "my.toml:3: part.count = 2.5: must be an integer from -5 to 10");
  EXPECT_EQ(set("part.count", ConfigValue(1e300)),
            "my.toml:3: part.count = 1e+300: must be an integer from -5 to 10");
}

TEST_F(SchemaTest, RefusesValuesOutOfRange) {
  EXPECT_EQ(set("part.count", ConfigValue(std::int64_t{11})),
            "my.toml:3: part.count = 11: must be an integer from -5 to 10");
  EXPECT_EQ(set("part.count", ConfigValue(std::int64_t{-6})),
            "my.toml:3: part.count = -6: must be an integer from -5 to 10");
  EXPECT_EQ(set("part.ratio", ConfigValue(1.51)),
            "my.toml:3: part.ratio = 1.51: must be a number from 0 to 1.5");
  EXPECT_EQ(set("part.ratio", ConfigValue(std::nan(""))),
            "my.toml:3: part.ratio = nan: must be a number from 0 to 1.5");
  EXPECT_EQ(set("other.part.shape", ConfigValue(std::string("oval"))),
            "my.toml:3: other.part.shape = \"oval\": must be one of round, square");
  EXPECT_EQ(set("part.paths", ConfigValue(std::string("w, x"))),
            "my.toml:3: part.paths = \"w, x\": must be one or more of w, n, e, separated by commas");
  EXPECT_EQ(set("part.paths", ConfigValue(std::string())),
            "my.toml:3: part.paths = \"\": must be one or more of w, n, e, separated by commas");
  EXPECT_EQ(fields_.count, 3);
}

TEST_F(SchemaTest, RefusesWrongTypes) {
  EXPECT_EQ(set("part.count", ConfigValue(std::string("many"))),
            "my.toml:3: part.count = \"many\": must be an integer from -5 to 10");
  EXPECT_EQ(set("part.count", ConfigValue(true)),
            "my.toml:3: part.count = true: must be an integer from -5 to 10");
  EXPECT_EQ(set("part.ratio", ConfigValue(true)),
            "my.toml:3: part.ratio = true: must be a number from 0 to 1.5");
  EXPECT_EQ(set("part.enabled", ConfigValue(std::int64_t{1})),
            "my.toml:3: part.enabled = 1: must be true or false");
  EXPECT_EQ(set("other.part.shape", ConfigValue(std::int64_t{1})),
            "my.toml:3: other.part.shape = 1: must be one of round, square");
  EXPECT_EQ(set("part.count", NotAValue{"an array", false}),
            "my.toml:3: part.count is an array: must be an integer from -5 to 10");
}

TEST_F(SchemaTest, NamesTheNearestKeyForAnUnknownOne) {
  EXPECT_EQ(set("part.cuont", ConfigValue(true)),
            "my.toml:3: unknown key part.cuont; the nearest is part.count");
  EXPECT_EQ(set("ratio", ConfigValue(true)), "my.toml:3: unknown key ratio; the nearest is part.ratio");
  EXPECT_EQ(set("part.count.depth", ConfigValue(true)),
            "my.toml:3: unknown key part.count.depth; the nearest is part.count");
}

TEST_F(SchemaTest, TellsASectionFromAKey) {
  EXPECT_EQ(set("part", ConfigValue(true)), "my.toml:3: part is a section, not a key");
  EXPECT_EQ(set("part", NotAValue{"a table", true}), kFine);
  EXPECT_EQ(set("prat", NotAValue{"a table", true}),
            "my.toml:3: unknown key prat; the nearest is part.ratio");
}

TEST_F(SchemaTest, KeepsTagAndSourceOfTheValue) {
  EXPECT_EQ(schema_.find("part.count")->provenance.tag, Tag::kStated);
  schema_.apply(
      {{"part.count", RawValue{ConfigValue(std::int64_t{1}), Tag::kFitted, "table 1", "a.toml:1"}}});
  EXPECT_EQ(schema_.find("part.count")->provenance.tag, Tag::kFitted);
  EXPECT_EQ(schema_.find("part.count")->provenance.source, "table 1");
  set("part.count", ConfigValue(std::int64_t{2}));
  EXPECT_EQ(schema_.find("part.count")->provenance.tag, Tag::kChoice);
  EXPECT_EQ(schema_.find("part.count")->provenance.source, "my.toml:3");
}

TEST_F(SchemaTest, ChecksFieldsThatAProgramFilledIn) {
  EXPECT_EQ(error_of([&] { schema_.check(); }), kFine);
  fields_.count = 40;
  EXPECT_EQ(error_of([&] { schema_.check(); }), "part.count = 40: must be an integer from -5 to 10");
}

TEST_F(SchemaTest, SplitsPathsAtTheFirstPoint) {
  EXPECT_EQ(schema_.find("other.part.shape")->section(), "other");
  EXPECT_EQ(schema_.find("other.part.shape")->name(), "part.shape");
}

TEST_F(SchemaTest, RefusesFaultyDeclarations) {
  EXPECT_THROW(schema_.integer("part.count", fields_.count, {0, 1}, "", "", chosen("")), std::logic_error);
  EXPECT_THROW(schema_.integer("part.new", fields_.narrow, {0, 256}, "", "", chosen("")), std::logic_error);
  EXPECT_THROW(schema_.integer("part.new", fields_.narrow, {-1, 5}, "", "", chosen("")), std::logic_error);
}

TEST(ConfigValue, RealsReadBackExactly) {
  EXPECT_EQ(to_toml(ConfigValue(2.0)), "2.0");
  EXPECT_EQ(to_toml(ConfigValue(0.1)), "0.1");
  EXPECT_EQ(to_toml(ConfigValue(1e30)), "1e+30");
  EXPECT_EQ(to_toml(ConfigValue(std::string("a \"b\"\\\n"))), "\"a \\\"b\\\"\\\\\\u000A\"");
}

RC_GTEST_PROP(ConfigValueProperty, RealsReadBackExactly, (double value)) {
  RC_ASSERT(std::stod(to_toml(ConfigValue(value))) == value);
}

TEST(NearestName, CountsSwappedNeighboursAsOneSlip) {
  EXPECT_EQ(nearest_name("ab", {"xb", "ba"}), "xb");  // one each: the first
  EXPECT_EQ(nearest_name("matching.1p", {"matching.interval", "matching.p1"}), "matching.p1");
  EXPECT_EQ(nearest_name("anything", {}), "");
}

}  // namespace schema_test
}  // namespace parallax
