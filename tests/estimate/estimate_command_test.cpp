// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/cli/program.hpp"
#include "traces/metrics.hpp"

namespace parallax::test {
namespace estimate_command_test {

class EstimateCommand : public testing::Test {
 protected:
  MetricGroup tree(const std::string& arguments, int code = 0) const {
    const Outcome outcome = program_("estimate --json " + arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return metrics_of(nlohmann::ordered_json::parse(outcome.out));
  }
  std::string error(const std::string& arguments) const {
    const Outcome outcome = program_("estimate " + arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    return outcome.err;
  }
  Program program_;
};

TEST_F(EstimateCommand, SaysWhatDoesNotFitAndEndsWithOne) {
  const Outcome outcome = program_("estimate --device zynq-7020");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.out.find("does not fit zynq-7020: "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(" RAMB18 of 280, "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(" too many"), std::string::npos) << outcome.out;
}

TEST_F(EstimateCommand, SaysWhatFitsAndEndsWithZero) {
  const Outcome outcome = program_("estimate --device zynq-7020 -d 64");
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  EXPECT_NE(outcome.out.find("\nfits zynq-7020\n"), std::string::npos) << outcome.out;
}

TEST_F(EstimateCommand, JsonHasTheNumbersOfTheText) {
  const MetricGroup small = tree("--device zynq-7020 --size 320x240 -d 64");
  EXPECT_TRUE(std::get<bool>(small.at("devices/zynq_7020/fits").value));
  EXPECT_NEAR(small.number("devices/zynq_7020/block_ram"), small.number("resources/block_ram") / 2.80, 1e-9);
  const MetricGroup large = tree("--device zynq-7020", 1);
  EXPECT_GT(large.number("devices/zynq_7020/block_ram"), 100);
  EXPECT_FALSE(std::get<bool>(large.at("devices/zynq_7020/fits").value));
}

TEST_F(EstimateCommand, WithoutADeviceItListsAllThatThereAre) {
  const Outcome outcome = program_("estimate");
  EXPECT_EQ(outcome.code, 0);
  for (const char* line : {"\n  zynq-7020      no: ", "\n  zynq-7045      yes: ", "\n  ecp5-85        no: "})
    EXPECT_NE(outcome.out.find(line), std::string::npos) << line;
  const MetricGroup all = tree("");
  EXPECT_EQ(all.word("resources/family"), "7 series");
  EXPECT_EQ(all.group_at("devices").groups.size(), 6U);
}

TEST_F(EstimateCommand, AFileOfTheUsersOwnIsADevice) {
  program_.folder().write("mine.toml", "inherits = \"zynq-7020\"\n[device]\nblock_rams = 2000\n");
  const Outcome own = program_("estimate --device ./mine.toml");
  EXPECT_EQ(own.code, 0) << own.err << own.out;
  EXPECT_NE(own.out.find("of     2000"), std::string::npos) << own.out;
}

TEST_F(EstimateCommand, QuietPrintsNothing) { EXPECT_EQ(program_("estimate -q").out, ""); }

TEST_F(EstimateCommand, RefusesWhatIsWrong) {
  EXPECT_NE(error("--device zynq-7021").find("zynq-7020"), std::string::npos);
  for (const char* size : {"640", "0x480", "640x0", "640x480x3", "99999x3"})
    EXPECT_NE(error(std::string("--size ") + size).find("expected width x height such as 640x480"),
              std::string::npos);
  EXPECT_NE(error("--size 5000x480").find("tiles.limit"), std::string::npos);
  EXPECT_NE(error("--set matching.pq=3").find("the nearest is matching.p1"), std::string::npos);
}

}  // namespace estimate_command_test
}  // namespace parallax::test
