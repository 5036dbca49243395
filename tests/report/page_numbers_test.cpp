// SPDX-License-Identifier: Apache-2.0
// Every number in the tables of a run's page is one of timing.json, by name, rounded as all are, thousands
// apart.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "tests/cli/printed_numbers.hpp"
#include "tests/cli/program.hpp"

namespace parallax::test {
namespace page_numbers_test {

std::string without_tags(const std::string& html) {
  std::string text = std::regex_replace(html, std::regex("<[^>]*>"), "");
  for (const auto& [code, character] :
       {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&nbsp;", " "}, {"&amp;", "&"}})
    text = std::regex_replace(text, std::regex(code), character);
  return text;
}

std::vector<std::string> all_between(const std::string& html, const std::string& begin,
                                     const std::string& end) {
  std::vector<std::string> found;
  for (std::size_t at = html.find(begin); at != std::string::npos; at = html.find(begin, at)) {
    at += begin.size();
    found.push_back(html.substr(at, html.find(end, at) - at));
  }
  return found;
}

// The rows of a section's first table, cell by cell, without its heading.
using Rows = std::vector<std::vector<std::string>>;
Rows table_of(const std::string& page, const std::string& section) {
  const std::string html = all_between(page, "<section id=\"" + section + "\"", "</section>").at(0);
  const std::string table = all_between(html, "<tbody>", "</tbody>").at(0);
  Rows rows;
  for (const std::string& row : all_between(table, "<tr", "</tr>")) {
    rows.emplace_back();
    static const std::regex cell("<t[hd][^>]*>(.*?)</t[hd]>");
    for (std::sregex_iterator it(row.begin(), row.end(), cell), none; it != none; ++it)
      rows.back().push_back(without_tags((*it)[1]));
  }
  return rows;
}

std::string without_blanks(std::string words) {
  std::replace(words.begin(), words.end(), ' ', '_');
  return words;
}

class PageNumbers : public ::testing::Test {
 protected:
  void run(const std::string& arguments) {
    const Outcome outcome = program_("run -q --report --out out " + arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    tree_ = Json::parse(program_.read("out/timing.json"));
    page_ = program_.read("out/report.html");
  }
  // As a cell says it; with its unit, or without where the heading has it.
  std::string cell(const std::string& path, bool unit) const {
    const Json* const entry = entry_at(tree_, path);
    if (entry == nullptr) return "";
    if (!entry->at("value").is_number()) return expected_with_unit(*entry);
    return naive_grouped(unit ? expected_with_unit(*entry) : expected_text(*entry));
  }
  /// Columns are the metrics of what the first cell names, "-" for a column that is none; "%" at the end of a
  /// path: with its unit.
  void expect_table(const std::string& section, const std::string& prefix,
                    const std::vector<std::string>& columns) const {
    const Rows rows = table_of(page_, section);
    ASSERT_GT(rows.size(), 2U) << section;
    for (const auto& row : rows) {
      ASSERT_EQ(row.size(), columns.size() + 1) << section;
      for (std::size_t i = 0; i < columns.size(); ++i) {
        if (columns[i] == "-") continue;
        const bool unit = columns[i].back() == '%';
        const std::string name = unit ? columns[i].substr(0, columns[i].size() - 1) : columns[i];
        EXPECT_EQ(row[i + 1], cell(prefix + without_blanks(row[0]) + name, unit))
            << section << ": " << row[0] << name;
      }
    }
  }
  void expect_tables() const {
    expect_table("stages", "stages/",
                 {"/cycles_per_frame", "-", "/utilisation%", "-", "/busy_share%", "/starved_share%",
                  "/blocked_share%", "/memory_share%", "/synchroniser_share%", "/blanking_share%"});
    expect_table("fifos", "streams/",
                 {"/depth", "/width%", "/kind%", "/mean_occupancy", "/high_water", "/full%", "/empty%",
                  "/blocked_on_full%", "/starved_on_empty%"});
    expect_table("memory", "memory/",
                 {"/bytes_per_frame", "/bandwidth", "/share%", "/latency_mean", "/latency_p50",
                  "/latency_p95", "/latency_p99", "/latency_largest", "/stalls%"});
    expect_table("pipeline", "limit/utilisation_by_part/", {"%", "-"});
    for (const auto& row : table_of(page_, "energy")) {
      EXPECT_EQ(row.at(1), cell("energy/power_" + without_blanks(row[0]), false));
      EXPECT_EQ(row.at(2), cell("energy/frame_" + without_blanks(row[0]), false));
    }
    for (const auto& row : table_of(page_, "numbers")) {
      if (entry_at(tree_, row.at(0))->at("value").is_array()) continue;
      EXPECT_EQ(row.at(1), cell(row[0], true)) << row[0];
    }
  }

  Program program_;
  Json tree_;
  std::string page_;
};

TEST_F(PageNumbers, OfTheTablesAreThoseOfTiming) {
  run("--timing-only --size 160x128 -d 64");
  expect_tables();
  for (auto row : table_of(page_, "latency")) {
    row[0] = without_blanks(std::regex_replace(row[0], std::regex("the host"), "host"));
    std::size_t column = 1;
    for (const char* what : {"first_frame", "mean", "p50", "p95", "p99", "largest"})
      EXPECT_EQ(row.at(column++), cell("latency/" + row[0] + "_" + what, false)) << row[0];
  }
}

TEST_F(PageNumbers, OfAMachineWithoutALinkSayNothingOfAHost) {
  run("--timing-only --size 64x48 -d 32 --set link.enabled=false --set clocks.core_hz=10000");
  expect_tables();
  const std::string shown = page_.substr(0, page_.find("<section id=\"numbers\""));
  EXPECT_EQ(without_tags(shown.substr(shown.find("<main"))).find("host"), std::string::npos);
}

// All that the machine stores on the chip, added up here from the declarations.
TEST_F(PageNumbers, OfTheStorageAreAllOfIt) {
  run("--timing-only --size 160x128 -d 64");
  double lines = 0, fifos = 0;
  for (const auto& [name, stage] : tree_.at("stages").items())
    lines += stage.at("storage").at("value").get<double>();
  for (const auto& [name, stream] : tree_.at("streams").items())
    fifos += stream.at("depth").at("value").get<double>() * stream.at("width").at("value").get<double>();
  const auto kibibits = [](double bits) {
    return naive_grouped(naive_number_text(bits / 1024, "Kibit")) + " Kibit";
  };
  const Rows rows = table_of(page_, "storage");
  EXPECT_EQ(rows.back(),
            (std::vector<std::string>{"all", kibibits(lines), kibibits(fifos), kibibits(lines + fifos)}));
  // Each column adds up to the last row but for what each row is rounded by.
  for (std::size_t column = 1; column <= 3; ++column) {
    double sum = 0;
    const auto number = [&](const std::vector<std::string>& row) {
      return std::stod(std::regex_replace(row.at(column), std::regex(","), ""));
    };
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) sum += number(rows[i]);
    EXPECT_NEAR(sum, number(rows.back()), 0.05 * static_cast<double>(rows.size())) << column;
  }
  const auto engine =
      std::find_if(rows.begin(), rows.end(), [](const auto& row) { return row[0] == "dma left"; });
  ASSERT_NE(engine, rows.end()) << "DMA engines have FIFOs, too";
  EXPECT_EQ(engine->at(3), "8.0 Kibit");  // 1 KiB
}

}  // namespace page_numbers_test
}  // namespace parallax::test
