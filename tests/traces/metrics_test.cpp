// SPDX-License-Identifier: Apache-2.0
// Metrics are read by path and kind, and JSON of them is read back as it was written.
#include "traces/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "traces/metric_bytes.hpp"
#include "traces/metric_table.hpp"

namespace parallax::test {
namespace metrics_test {

using Json = nlohmann::ordered_json;

MetricGroup example() {
  MetricGroup root;
  root.group("input").metrics.push_back({"width", std::int64_t{640}, "px", "Of the images.", ""});
  MetricGroup& memory = root.group("memory");
  memory.metrics.push_back({"share", 7.5, "%", "Of the time.", "frames 8 to 9"});
  memory.group("map").metrics.push_back(
      {"depths", std::vector<std::int64_t>{1, 2}, "tokens", "A row of numbers.", ""});
  memory.group("map").metrics.push_back({"kind", std::string("registered"), "", "A word.", ""});
  memory.group("map").metrics.push_back({"window", true, "", "Named like a part of a metric.", ""});
  return root;
}

std::string error_of(const std::function<void()>& read) {
  try {
    read();
  } catch (const MetricError& error) {
    return error.what();
  }
  return "";
}

TEST(Metrics, AreReadByPathAndKind) {
  const MetricGroup root = example();
  EXPECT_EQ(root.count("input/width"), 640);
  EXPECT_EQ(root.number("input/width"), 640.0);
  EXPECT_EQ(root.number("memory/share"), 7.5);
  EXPECT_EQ(root.word("memory/map/kind"), "registered");
  EXPECT_EQ(root.at("memory/share").window, "frames 8 to 9");
  EXPECT_EQ(root.group_at("memory/map").metrics.size(), 3U);
  EXPECT_EQ(root.group_at("memory").number("share"), 7.5);
  EXPECT_EQ(root.number_or("memory/bandwidth", 3), 3);
  EXPECT_EQ(root.number_or("memory/share", 3), 7.5);
  EXPECT_EQ(root.word_or("limit/part", "none"), "none");
}

TEST(Metrics, WhatIsNotThereIsNamed) {
  const MetricGroup root = example();
  EXPECT_EQ(root.find("share"), nullptr);
  EXPECT_EQ(root.find("memory"), nullptr);  // a group
  EXPECT_EQ(root.find_group("memory/share"), nullptr);
  EXPECT_EQ(error_of([&] { root.number("memory/left/share"); }), "it has no memory/left/share");
  EXPECT_EQ(error_of([&] { root.group_at("memory/left"); }), "it has no memory/left");
  EXPECT_EQ(error_of([&] { root.number("memory/map/kind"); }), "memory/map/kind is no number");
  EXPECT_EQ(error_of([&] { root.word("memory/share"); }), "memory/share is no text");
  EXPECT_EQ(error_of([&] { root.count("memory/share"); }), "memory/share is no whole number");
  EXPECT_EQ(error_of([&] { root.number_or("memory/map/kind", 0); }), "memory/map/kind is no number");
}

TEST(Metrics, JsonIsReadBackAsItWasWritten) {
  const Json tree = to_json(example());
  EXPECT_EQ(to_json(metrics_of(tree)).dump(), tree.dump());
  EXPECT_EQ(to_json(metrics_of(Json::parse(tree.dump()))).dump(), tree.dump());
}

TEST(Metrics, WhatJsonCannotHoldIsNoNumber) {
  MetricGroup root;
  root.metrics.push_back({"rate", std::numeric_limits<double>::infinity(), "1/s", "Of nothing.", ""});
  EXPECT_TRUE(std::isnan(metrics_of(Json::parse(to_json(root).dump())).number("rate")));
}

TEST(Metrics, OtherEntriesAreLeftOut) {
  Json tree = to_json(example());
  tree["schema"] = 1;
  tree["list"] = Json::array({1, 2});
  EXPECT_EQ(to_json(metrics_of(tree)).dump(), to_json(example()).dump());
}

TEST(Metrics, DamageIsNamed) {
  const auto damage = [](const char* key, const Json& value) {
    Json tree = to_json(example());
    tree["memory"]["share"][key] = value;
    return error_of([&] { metrics_of(tree); });
  };
  EXPECT_EQ(damage("unit", 7), "memory/share is no metric: its unit is no text");
  EXPECT_EQ(damage("window", nullptr), "memory/share is no metric: its window is no text");
  EXPECT_EQ(damage("value", Json::array({"x"})),
            "memory/share is no metric: its value is neither number nor text");
  Json tree = to_json(example());
  tree["memory"]["share"].erase("value");
  EXPECT_EQ(error_of([&] { metrics_of(tree); }), "memory/share is no metric: it has no value");
  tree = to_json(example());
  tree["memory"]["share"].erase("unit");
  EXPECT_EQ(error_of([&] { metrics_of(tree); }), "memory/share is no metric: it has no unit");
}

const MetricTable& table() {
  static const MetricTable rows{{"rate", "1/s", "A rate.", kSteadyState},
                                {"memory/<port>/kind", "", "A word.", ""},
                                {"latency/<span>_mean", "ms", "What frames took <span>.", kWholeRun}};
  return rows;
}

TEST(MetricWriter, WritesWhatTheRowSays) {
  MetricGroup root;
  const MetricWriter out = MetricWriter(root, table()).over("frames 2 to 4");
  out.add("rate", 7.0);
  out.of("left").add("memory/<port>/kind", std::string("narrow"));
  MetricWriter(root, table()).of("first", "to the first pixel").add("latency/<span>_mean", 2.5);
  EXPECT_EQ(root.number("rate"), 7);
  EXPECT_EQ(root.at("rate").window, "frames 2 to 4");
  EXPECT_EQ(root.word("memory/left/kind"), "narrow");
  EXPECT_EQ(root.at("memory/left/kind").window, "");  // no measurement
  EXPECT_EQ(root.at("latency/first_mean").unit, "ms");
  EXPECT_EQ(root.at("latency/first_mean").window, "the whole run");
  EXPECT_EQ(root.at("latency/first_mean").description, "What frames took to the first pixel.");
}

TEST(MetricWriter, WritesNothingThatIsNotInTheTable) {
  MetricGroup root;
  EXPECT_THROW(MetricWriter(root, table()).add("memory/left/kind", std::string("narrow")), std::logic_error);
}

TEST(Metrics, ComeBackFromBytesAsTheyWere) {
  MetricGroup root = example();
  root.metrics.push_back({"least", std::numeric_limits<std::int64_t>::min(), "", "", ""});
  root.metrics.push_back({"most", std::numeric_limits<std::int64_t>::max(), "", "", ""});
  root.metrics.push_back({"nothing", std::vector<std::int64_t>{}, "tokens", "", ""});
  root.metrics.push_back({"below", std::vector<std::int64_t>{-1, 0, 1}, "tokens", "", ""});
  root.metrics.push_back({"infinite", -std::numeric_limits<double>::infinity(), "s", "", ""});
  root.metrics.push_back({"whole_real", 5.0, "s", "", ""});
  root.metrics.push_back({"any_bytes", std::string("\0\xff", 2), "", "", ""});
  root.group("empty");
  const MetricGroup back = metrics_from_bytes(to_bytes(root));
  EXPECT_EQ(to_bytes(back), to_bytes(root));
  for (std::size_t i = 0; i < root.metrics.size(); ++i) {
    EXPECT_EQ(back.metrics[i].name, root.metrics[i].name);
    EXPECT_EQ(back.metrics[i].value, root.metrics[i].value) << root.metrics[i].name;
  }
  EXPECT_EQ(to_json(metrics_from_bytes(to_bytes(example()))), to_json(example()));
  EXPECT_EQ(back.groups.back().name, "empty");
}

TEST(Metrics, BytesThatAreCutAreNone) {
  const std::string bytes = to_bytes(example());
  EXPECT_EQ(error_of([&] { metrics_from_bytes(bytes.substr(0, bytes.size() - 1)); }),
            "these bytes are no metrics: end of buffer exception");
}

}  // namespace metrics_test
}  // namespace parallax::test
