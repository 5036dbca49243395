// SPDX-License-Identifier: Apache-2.0
// The numbers of the other commands' tables are those of their JSON, rounded as all are.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/cli/printed_numbers.hpp"
#include "tests/cli/program.hpp"

namespace parallax::test {
namespace printed_tables_test {

std::string with_sign(double value, const std::string& unit) {
  return (value > 0 ? "+" : "") + naive_number_text(value, unit);
}

class PrintedTables : public ::testing::Test {
 protected:
  std::vector<std::string> run(const std::string& arguments, int code = 0) const {
    const Outcome outcome = program_(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return lines(outcome.out);
  }
  Json json(const std::string& name) const { return Json::parse(program_.read(name)); }
  // A table's line, which must be there, once.
  static std::string line_of(const std::vector<std::string>& all, const std::string& name) {
    std::vector<std::string> found;
    for (const std::string& line : all) {
      if (with_single_blanks(line).rfind(name + " ", 0) == 0) found.push_back(line);
    }
    EXPECT_EQ(found.size(), 1U) << name;
    return found.empty() ? "" : found.front();
  }

  Program program_;
};

TEST_F(PrintedTables, Vary) {
  const std::vector<std::string> table =
      run("run --timing-only --size 160x128 --vary matching.iterations=1,4 --vary clocks.core_hz=1e6,188e6 "
          "--out out");
  ASSERT_EQ(table.size(), 5U);
  EXPECT_EQ(with_single_blanks(table[0]),
            "point matching.iterations clocks.core_hz disparities frame rate latency limit");
  for (std::size_t i = 0; i < 4; ++i) {
    const PrintedLine row(
        fmt::format("{} {} {} {{input/disparity_range#px}} {{performance/frame_rate}} "
                    "{{latency/exposure_to_host_mean}} {{limit/part}} at {{limit/utilisation}}",
                    i, i < 2 ? 1 : 4, i % 2 == 0 ? "1e6" : "188e6"));
    EXPECT_TRUE(row.explains(table[i + 1], json(fmt::format("out/point_{:04}/timing.json", i))))
        << table[i + 1];
  }
}

TEST_F(PrintedTables, VarySaysWhichPartIsBusiestWhereNoneLimits) {
  const std::vector<std::string> table = run(
      "run --timing-only --size 64x48 --set link.output_buffers=1 --vary camera.frame_buffers=1 --out out");
  const PrintedLine row(
      "0 1 {performance/frame_rate} {latency/exposure_to_host_mean} none; "
      "{limit/next_part} at {limit/utilisation}");
  EXPECT_TRUE(row.explains(table.at(1), json("out/point_0000/timing.json"))) << table.at(1);
}

TEST_F(PrintedTables, Relax) {
  const std::vector<std::string> table = run("run --timing-only --relax --size 160x128 -d 64 --out out");
  const Json tree = json("out/relaxations.json");
  EXPECT_EQ(with_single_blanks(table.at(0)), "limit taken away frame rate latency gain");
  EXPECT_TRUE(PrintedLine("none {frame_rate} {latency}").explains(line_of(table, "none"), tree.at("base")));
  for (const Json& entry : tree.at("relaxations")) {
    const std::string name = entry.at("name");
    const Derived derived{
        {"gain", [](const Json& of) { return with_sign(of.at("gain").at("value"), "%") + " %"; }},
        {"meaning", [](const Json& of) { return of.at("meaning").get<std::string>(); }}};
    EXPECT_TRUE(PrintedLine(name + " {frame_rate} {latency} {=gain} {=meaning}")
                    .explains(line_of(table, name), entry, derived))
        << line_of(table, name);
  }
  EXPECT_EQ(table.size(), tree.at("relaxations").size() + 4);  // heading, none, limit, verdict
}

TEST_F(PrintedTables, Validate) {
  const std::vector<std::string> table = run("validate --rows other-designs --out out");
  const Json rows = json("out/validation.json").at("rows");
  ASSERT_EQ(table.size(), rows.size() + 1);
  for (const Json& row : rows) {
    const std::string name = row.at("name"), unit = row.at("unit");
    const std::string line = with_single_blanks(line_of(table, name));
    const std::string numbers = fmt::format(" {} {} {} {} % ", row.at("published").get<double>(),
                                            naive_number_text(row.at("predicted"), unit), unit,
                                            with_sign(row.at("deviation_percent"), "%"));
    EXPECT_NE(line.find(numbers), std::string::npos) << line << "\n" << numbers;
  }
}

TEST_F(PrintedTables, Memory) {
  std::ofstream(program_ / "trace.csv")
      << "time_ns,rw,addr,bytes\n0,r,0,64\n500,w,4096,64\n1000,r,65536,256\n";
  const std::vector<std::string> table = run("memory trace.csv --config ddr3-1066-x32");
  std::string printed;
  for (const std::string& line : run("memory trace.csv --config ddr3-1066-x32 --json"))
    printed += line + "\n";
  const Json tree = Json::parse(printed);
  EXPECT_EQ(table.size(), tree.size());
  for (const auto& [name, entry] : tree.items()) {
    const std::string unit = entry.at("unit");
    EXPECT_EQ(with_single_blanks(line_of(table, name)),
              name + " " + expected_text(entry) + (unit.empty() ? "" : " " + unit));
  }
}

TEST_F(PrintedTables, MapInfo) {
  run("scene --size 96x64 --out in");
  const std::vector<std::string> encoded = run("map encode --calibration in/calib.yml --out lens.map");
  std::string printed;
  for (const std::string& line : run("map info lens.map --json")) printed += line + "\n";
  const Json tree = Json::parse(printed);
  const auto bytes = [&](const Json& value) { return naive_number_text(value, "B"); };
  const auto offset = [&](const char* side, const char* axis) {
    return naive_number_text(tree.at("largest_offset_px").at(side).at(axis), "px");
  };
  const Json& rows = tree.at("row_bytes");
  const int reach = (tree.at("window_px").get<int>() - 1) / 2;
  const std::vector<std::string> expected{
      fmt::format("size {}x{} px", tree.at("width_px").dump(), tree.at("height_px").dump()),
      fmt::format("window {} px (-{}..+{}), {} fraction bits", tree.at("window_px").dump(), reach, reach,
                  tree.at("fraction_bits").dump()),
      fmt::format("stream {} bytes, {} bytes per pixel and image (at most {})",
                  tree.at("stream_bytes").dump(), bytes(tree.at("bytes_per_pixel_and_image")),
                  bytes(tree.at("worst_case_bytes_per_pixel_and_image"))),
      fmt::format("file {} bytes", tree.at("file_bytes").dump()),
      fmt::format("largest offsets, left {} px horizontally, {} px vertically", offset("left", "x"),
                  offset("left", "y")),
      fmt::format("largest offsets, right {} px horizontally, {} px vertically", offset("right", "x"),
                  offset("right", "y")),
      fmt::format("bytes per row {} least, {} mean, {} largest, {} worst case", rows.at("least").dump(),
                  bytes(rows.at("mean")), rows.at("largest").dump(), rows.at("worst_case").dump())};
  const std::vector<std::string> table = run("map info lens.map");
  ASSERT_EQ(table.size(), expected.size());
  for (std::size_t i = 0; i < table.size(); ++i) EXPECT_EQ(with_single_blanks(table[i]), expected[i]);
  ASSERT_EQ(encoded.size(), 1U);
  EXPECT_EQ(encoded[0],
            fmt::format("lens.map: 96x64 px, {} bytes, {} bytes per pixel and image",
                        tree.at("stream_bytes").dump(), bytes(tree.at("bytes_per_pixel_and_image"))));
}

// "100.26 fps" of both runs, though they differ, would say that they do not.
std::string beside(const Json* entry, const Json* other) {
  if (entry == nullptr) return "-";
  const std::string text = expected_with_unit(*entry);
  const bool same =
      other != nullptr && entry->at("value").is_number_float() && text == expected_with_unit(*other);
  if (same) return entry->at("value").dump() + " " + expected_unit(*entry);
  constexpr std::size_t kLongest = 40;
  return !entry->at("value").is_string() || text.size() <= kLongest ? text
                                                                    : text.substr(0, kLongest - 3) + "...";
}

TEST_F(PrintedTables, CompareRuns) {
  run("run -q --timing-only --size 160x128 -d 64 --out a");
  run("run -q --timing-only --size 160x128 -d 64 --set clocks.core_hz=187999999 --out b");
  const std::vector<std::string> table = run("compare-runs a b --all");
  const Json a = json("a/timing.json"), b = json("b/timing.json");
  const auto begin = std::find(table.begin(), table.end(), "results");
  ASSERT_GT(table.end() - begin, 50);
  int say_all = 0;
  for (auto line = begin + 1; line != table.end(); ++line) {
    const std::string text = with_single_blanks(*line), name = text.substr(0, text.find(' '));
    const Json *const of_a = entry_at(a, name), *const of_b = entry_at(b, name);
    if (of_a != nullptr && of_a->at("value").is_array()) continue;  // rows of numbers, cut short
    std::string expected = name + " " + beside(of_a, of_b) + " " + beside(of_b, of_a);
    const bool shares = of_a != nullptr && of_a->at("unit") == "%";
    if (of_a != nullptr && of_b != nullptr && of_a->at("value").is_number() && !shares &&
        of_a->at("value") != 0) {
      const double change = 100 * (of_b->at("value").get<double>() / of_a->at("value").get<double>() - 1);
      expected += " " + with_sign(change, "%") + " %";
    }
    EXPECT_EQ(text, expected);
    say_all += of_a != nullptr && of_b != nullptr && of_a->at("value").is_number_float() &&
                       expected_text(*of_a) == expected_text(*of_b)
                   ? 1
                   : 0;
  }
  EXPECT_GT(say_all, 10) << "no two numbers that are nearly the same";
}

}  // namespace printed_tables_test
}  // namespace parallax::test
