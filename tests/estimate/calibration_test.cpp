// SPDX-License-Identifier: Apache-2.0
// The estimates of the reference circuits beside what yosys makes of these: of parameters that were not used
// to fit anything, too.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "platform/config/preset.hpp"
#include "tests/estimate/recorded_circuits.hpp"

namespace parallax::test {
namespace calibration_test {

constexpr double kTolerance = 0.20;
constexpr std::int64_t kFewCells = 30;  // of a FIFO: where 20 % would be a handful

const DeviceFile& family(const std::string& name) {
  static std::map<std::string, DeviceFile> all;
  const auto found = all.find(name);
  return found != all.end()
             ? found->second
             : all.emplace(name, load_family(name, {source_path("platform/presets")})).first->second;
}

bool near(std::int64_t estimated, std::int64_t made, std::int64_t few) {
  const std::int64_t error = std::abs(estimated - made);
  return error <= few || static_cast<double>(error) <= kTolerance * static_cast<double>(made);
}

std::string percent(std::int64_t estimated, std::int64_t made) {
  if (made == 0) return estimated == 0 ? "0" : "-";
  return fmt::format("{:+.1f} %", 100.0 * static_cast<double>(estimated - made) / static_cast<double>(made));
}

const char* described(const std::string& use) {
  return use == "held_out" ? "held out" : use == "calibrate" ? "fitted" : "not calibrated";
}

// Mean and largest error of the held-out circuits of a family, in percent.
std::string summary(const std::string& name) {
  double sum_luts = 0, most_luts = 0, sum_registers = 0, most_registers = 0;
  int number = 0, blocks = 0, wrong_blocks = 0;
  const auto error = [](std::int64_t guess, std::int64_t made) {
    return 100.0 * static_cast<double>(std::abs(guess - made)) / static_cast<double>(made);
  };
  for (const RecordedCircuit& c : recorded_circuits()) {
    if (c.family != name || c.use != "held_out") continue;
    const Resources e = estimated(c, family(name));
    const double luts = error(e.luts(), c.cells.luts());
    const double registers = error(e.registers, c.cells.registers);
    sum_luts += luts;
    sum_registers += registers;
    most_luts = std::max(most_luts, luts);
    most_registers = std::max(most_registers, registers);
    ++number;
    blocks += c.cells.block_rams > 0 ? 1 : 0;
    wrong_blocks += e.block_rams != c.cells.block_rams ? 1 : 0;
  }
  return fmt::format("| {} | {} | {:.1f} % | {:.1f} % | {:.1f} % | {:.1f} % | {} of {} |\n", name, number,
                     sum_luts / number, most_luts, sum_registers / number, most_registers,
                     blocks - wrong_blocks, blocks);
}

// The table of platform/doc/estimates.md.
std::string table() {
  std::string text =
      "| family | held out | LUT, mean error | largest | FF, mean error | largest | block RAMs right |\n"
      "|---|---|---|---|---|---|---|\n" +
      summary("7-series") + summary("ultrascale-plus") + summary("ecp5") + "\n";
  text +=
      "| family | circuit | parameters | | LUT made | estimated | error | FF made | estimated | error | "
      "block "
      "RAM made | estimated | DSP made | estimated "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const RecordedCircuit& c : recorded_circuits()) {
    const Resources e = estimated(c, family(c.family));
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", c.family,
                        c.circuit, c.text(), described(c.use), c.cells.luts(), e.luts(),
                        percent(e.luts(), c.cells.luts()), c.cells.registers, e.registers,
                        percent(e.registers, c.cells.registers), c.cells.block_rams, e.block_rams,
                        c.cells.dsps, e.dsps);
  }
  return text;
}

// For calibrate.py: what each cost is multiplied by.
std::string features() {
  auto rows = nlohmann::json::array();
  for (const RecordedCircuit& c : recorded_circuits()) {
    DeviceFile device = family(c.family);
    device.costs = {};
    const std::int64_t known = estimated(c, device).logic_luts;
    nlohmann::json row{{"family", c.family}, {"use", c.use}, {"luts", c.cells.logic_luts}, {"known", known}};
    for (const CircuitCost& cost : circuit_costs()) {
      if (!cost.fitted) continue;
      device.costs.*cost.member = 1;
      row["features"][cost.key] = estimated(c, device).logic_luts - known;
      device.costs.*cost.member = 0;
    }
    rows.push_back(row);
  }
  return rows.dump();
}

TEST(Calibration, WritesWhatIsAskedFor) {
  if (const char* file = std::getenv("PARALLAX_CALIBRATION_FEATURES")) std::ofstream(file) << features();
  if (const char* file = std::getenv("PARALLAX_CALIBRATION_TABLE")) std::ofstream(file) << table();
}

TEST(Calibration, HeldOutCircuitsAreWithinTwentyPercent) {
  int held_out = 0;
  for (const RecordedCircuit& c : recorded_circuits()) {
    if (c.use == "calibrate") continue;
    held_out += c.use == "held_out" ? 1 : 0;
    const Resources e = estimated(c, family(c.family));
    const std::string where = c.family + " " + c.circuit + " " + c.text();
    const std::int64_t few = c.circuit.rfind("fifo_", 0) == 0 ? kFewCells : 0;
    EXPECT_TRUE(c.use != "held_out" || near(e.luts(), c.cells.luts(), few))
        << where << ": LUT " << e.luts() << ", made " << c.cells.luts();
    EXPECT_TRUE(near(e.registers, c.cells.registers, few))
        << where << ": FF " << e.registers << ", made " << c.cells.registers;
    EXPECT_TRUE(near(e.block_rams, c.cells.block_rams, 0))
        << where << ": block RAM " << e.block_rams << ", made " << c.cells.block_rams;
    EXPECT_TRUE(near(e.memory_luts(), c.cells.memory_luts(), few))
        << where << ": LUT as memory " << e.memory_luts() << ", made " << c.cells.memory_luts();
    EXPECT_EQ(e.dsps, c.cells.dsps) << where;
  }
  EXPECT_GE(held_out, 58);
}

TEST(Calibration, ThePageHasThisTable) {
  const std::string page = read_text(source_path("platform/doc/estimates.md"));
  EXPECT_NE(page.find(table()), std::string::npos) << "run: tests/estimate/calibrate.py fit BUILD";
}

TEST(Calibration, LargeRecordComesOutAgain) {
  if (std::system("yosys -V > /dev/null 2>&1") != 0) GTEST_SKIP() << "no yosys";
  const std::string script = source_path("tests/estimate/calibrate.py");
  EXPECT_EQ(std::system((script + " check ecp5 fifo_block_ram DEPTH=16 WIDTH=8").c_str()), 0);
}

}  // namespace calibration_test
}  // namespace parallax::test
