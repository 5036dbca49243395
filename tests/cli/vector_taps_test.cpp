// SPDX-License-Identifier: Apache-2.0
// parallax vectors --taps, and parallax compare with what it writes, as their user meets them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"

namespace parallax {
namespace vector_taps_test {

using nlohmann::json;

constexpr int kWidth = 32, kHeight = 16, kParallelism = 8, kIterations = 3;
constexpr const char* kMatcher =
    "--size 32x16 --frames 2 -s matching.parallelism=8 -s matching.iterations=3 ";
constexpr const char* kEight = "-s matching.paths=w,nw,n,ne,e,sw,s,se ";

// The costs of a file, in the order of its tokens: a token's first is lowest.
using Values = std::vector<int>;

class VectorTaps : public ::testing::Test {
 protected:
  json make(const std::string& more = "--taps", const std::string& folder = "v") const {
    const test::Outcome outcome =
        program_(fmt::format("vectors --stage matching {} {} --out {} --json", kMatcher, more, folder));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return json::parse(outcome.out);
  }
  static json stream(const json& manifest, const std::string& name) {
    for (const json& each : manifest.at("streams")) {
      if (each.at("name") == name) return each;
    }
    return nullptr;
  }
  Values values(const std::string& file, int bits) const {
    Values out;
    for (const std::string& line : test::lines(program_.read(file))) {
      for (int low = 0; low < kParallelism * bits; low += bits) {
        int value = 0;
        for (int i = 0; i < bits; ++i) {
          const char c = line[line.size() - 1 - static_cast<std::size_t>((low + i) / 4)];
          const int digit = c <= '9' ? c - '0' : c - 'a' + 10;
          value |= (digit >> (low + i) % 4 & 1) << i;
        }
        out.push_back(value);
      }
    }
    return out;
  }
  void write(const std::string& file, const Values& values, int bits) const {
    const int digits = (kParallelism * bits + 3) / 4;
    std::string text;
    for (std::size_t at = 0; at < values.size(); at += kParallelism) {
      std::string line;
      for (int digit = digits - 1; digit >= 0; --digit) {
        int value = 0;
        for (int i = 0; i < 4; ++i) {
          const int bit = 4 * digit + i;
          if (bit >= kParallelism * bits) continue;
          value |= (values[at + static_cast<std::size_t>(bit / bits)] >> bit % bits & 1) << i;
        }
        line += "0123456789abcdef"[value];
      }
      text += line + "\n";
    }
    program_.folder().write(file, text);
  }
  // Where a value of the raster order is in a tap.
  static std::size_t place(const std::string& order, std::size_t at) {
    constexpr std::size_t pixel = kParallelism * kIterations;
    const std::size_t k = at % pixel, row = at / pixel / kWidth, x = at / pixel % kWidth;
    const std::size_t y = row % kHeight;
    const std::size_t there_x = order == "raster" ? x : kWidth - 1 - x;
    const std::size_t there_y = order == "turned" ? kHeight - 1 - y : y;
    return ((row - y + there_y) * kWidth + there_x) * pixel + k;
  }
  json compare(const std::string& dump, int code = 1) const {
    const test::Outcome outcome = program_("compare --vectors v --json --dump " + dump);
    EXPECT_EQ(outcome.code, code) << outcome.err << outcome.out;
    return json::parse(outcome.out);
  }
  static std::vector<std::string> names(const json& patterns) {
    std::vector<std::string> out;
    for (const json& pattern : patterns) out.push_back(pattern.at("name"));
    return out;
  }
  std::string refusal(const std::string& arguments) const {
    const test::Outcome outcome = program_(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments << '\n' << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(test::lines(outcome.err).size(), 1U) << outcome.err;
    const std::string prefix = "parallax: error: ";
    return outcome.err.substr(std::min(prefix.size(), outcome.err.size()));
  }

  test::Program program_;
};

TEST_F(VectorTaps, AreFilesBesideTheStreams) {
  const json manifest = make();
  std::vector<std::string> all;
  for (const json& each : manifest.at("streams")) all.push_back(each.at("name"));
  EXPECT_EQ(all, (std::vector<std::string>{"left_codes", "right_codes", "costs_subpixel", "pixel_costs",
                                           "path_w", "path_nw", "path_n", "path_ne"}));
  const json path = stream(manifest, "path_ne");
  EXPECT_EQ(path.at("direction"), "tap");
  EXPECT_EQ(path.at("port"), "path_ne");
  EXPECT_EQ(path.at("file"), "path_ne.memh");
  EXPECT_EQ(path.at("order"), "raster");
  EXPECT_EQ(path.at("path"), json::parse(R"({"dx": 1, "rows_up": 1, "start": "cost"})"));
  EXPECT_EQ(path.at("width"), 8 * 9);
  EXPECT_EQ(path.at("fields").size(), 8U);
  EXPECT_EQ(path.at("fields").at(7),
            json::parse(R"({"name": "cost_7", "low": 63, "bits": 9, "signed": false})"));
  const json costs = stream(manifest, "pixel_costs");
  EXPECT_EQ(costs.at("direction"), "tap");
  EXPECT_EQ(costs.at("width"), 8 * 6);  // of twice 24 differing bits
  EXPECT_FALSE(costs.contains("path"));
  for (const char* const key :
       {"tokens", "tokens_per_frame", "tokens_per_row", "tokens_per_pixel", "first_disparity"}) {
    EXPECT_EQ(path.at(key), stream(manifest, "costs_subpixel").at(key)) << key;
    EXPECT_EQ(costs.at(key), path.at(key)) << key;
  }
}

TEST_F(VectorTaps, AreNotPortsOfTheTestBench) {
  make();
  const json plain = make("--dates", "w");
  for (const char* const file :
       {"matching_tb.sv", "matching_stub.sv", "costs_subpixel.memh", "left_codes.memh"})
    EXPECT_EQ(program_.read(fmt::format("v/{}", file)), program_.read(fmt::format("w/{}", file))) << file;
  EXPECT_EQ(plain.at("streams").size(), 3U);
  EXPECT_EQ(program_.read("w/path_w.memh"), "");
}

TEST_F(VectorTaps, HaveNoDatesAndGoWithTheNextVectors) {
  EXPECT_FALSE(stream(make("--taps --dates"), "path_w").contains("dates_file"));
  const auto has = [this](const char* file) {
    const auto files = program_.files("v");
    return std::find(files.begin(), files.end(), file) != files.end();
  };
  EXPECT_TRUE(has("path_w.memh"));
  EXPECT_FALSE(has("path_w.dates"));
  make("");
  EXPECT_TRUE(has("costs_subpixel.memh"));
  EXPECT_FALSE(has("path_w.memh"));
}

TEST_F(VectorTaps, AreSaidWithTheStreams) {
  const std::string out = program_(fmt::format("vectors --stage matching {} --taps --out v", kMatcher)).out;
  EXPECT_NE(out.find("  costs_subpixel    out 3,072 tokens of 88 bits\n"
                     "  pixel_costs       tap 3,072 tokens of 48 bits\n"
                     "  path_w            tap 3,072 tokens of 72 bits\n"),
            std::string::npos)
      << out;
}

// The output is the sum of the paths, wherever each of them has the pixel.
TEST_F(VectorTaps, AddUpToTheOutput) {
  struct Case {
    std::string options;
    int path_bits, sum_bits, shift;
  };
  for (const Case& each :
       {Case{"", 9, 11, 0}, Case{kEight, 9, 12, 0},
        Case{std::string(kEight) + "-s matching.path_bits=6 -s matching.sum_shift=2 -s "
                                   "matching.path_start=delay_line -s matching.path_storage=memory",
             6, 7, 2}}) {
    const json manifest = make("--taps " + each.options);
    Values sums(values("v/costs_subpixel.memh", each.sum_bits).size());
    ASSERT_EQ(sums.size(), static_cast<std::size_t>(2 * kWidth * kHeight * kParallelism * kIterations));
    for (const json& tap : manifest.at("streams")) {
      if (!tap.contains("path")) continue;
      ASSERT_EQ(tap.at("width"), kParallelism * each.path_bits);
      const Values path = values("v/" + tap.at("file").get<std::string>(), each.path_bits);
      ASSERT_EQ(path.size(), sums.size());
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += path[place(tap.at("order"), i)];
    }
    for (int& sum : sums) sum >>= each.shift;
    EXPECT_TRUE(sums == values("v/costs_subpixel.memh", each.sum_bits)) << each.options;
  }
}

// At the beginning of each path stands the matching cost itself.
TEST_F(VectorTaps, BeginWithTheMatchingCosts) {
  const json manifest = make(std::string("--taps ") + kEight);
  const Values costs = values("v/pixel_costs.memh", 6);
  for (const json& tap : manifest.at("streams")) {
    if (!tap.contains("path")) continue;
    const Values path = values("v/" + tap.at("file").get<std::string>(), 9);
    for (std::size_t i = 0; i < costs.size(); ++i) {
      const std::size_t there = place(tap.at("order"), i);
      if (there / (kParallelism * kIterations) % (kWidth * kHeight) != 0) continue;
      EXPECT_EQ(path[there], costs[i]) << tap.at("name") << ' ' << i;
    }
  }
}

TEST_F(VectorTaps, OfTilesAreTileByTile) {
  const std::string tiles =
      "--taps --size 128x16 -s tiles.limit=96 -s tiles.left_margin=8 -s tiles.right_margin=8 ";
  const json manifest = make(tiles + kEight);
  ASSERT_GT(manifest.at("size").at("tile_begins").size(), 1U);
  std::uint64_t tokens = 0;
  for (const json& each : manifest.at("streams")) {
    if (each.at("name") == "costs_subpixel") tokens = each.at("tokens");
  }
  for (const json& each : manifest.at("streams")) {
    if (each.at("direction") == "tap") {
      EXPECT_EQ(each.at("tokens"), tokens);
    }
  }
}

TEST_F(VectorTaps, AreComparedAlone) {
  make();
  EXPECT_EQ(
      program_("compare --vectors v --dump path_nw=v/path_nw.memh --dump pixel_costs=v/pixel_costs.memh").out,
      "path_nw: equal, 3072 tokens\npixel_costs: equal, 3072 tokens\n");
  // The first output stream is none of them.
  EXPECT_EQ(compare("v/costs_subpixel.memh", 0).at("streams").at(0).at("stream"), "costs_subpixel");
}

// A fault in a path goes on along it; told is where it comes in.
TEST_F(VectorTaps, WhereAPathGoesWrongIsTold) {
  make();
  Values path = values("v/path_nw.memh", 9);
  constexpr int pixel = kParallelism * kIterations;
  const auto at = [](int x, int y, int k) { return static_cast<std::size_t>((y * kWidth + x) * pixel + k); };
  // From row 1 on, of each second pixel in column 1 or more: disparity 23, then along the path the others.
  for (int y = 1; y < kHeight; ++y) {
    for (int x = 1; x < kWidth; ++x) {
      const int behind = std::min({(y - 1) % 5, (x - 1) % 5, 4});
      for (int k = pixel - 1 - behind; k < pixel; ++k) path[at(x, y, k)] ^= 1 + (x + y) % 3;
    }
  }
  write("wrong.memh", path, 9);
  const test::Outcome outcome = program_("compare --vectors v --dump path_nw=wrong.memh");
  EXPECT_NE(
      outcome.out.find("first difference    frame 0, row 1, column 1, disparity 23, cost_7 of token 101: "),
      std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("pattern             path nw: it goes wrong at disparity 23, from row 1 on; all "
                             "else that differs lies "
                             "behind a pixel that does\n"),
            std::string::npos)
      << outcome.out;
  // Where it comes in says more than that the first row is equal.
  EXPECT_EQ(outcome.out.find("the first row is equal"), std::string::npos) << outcome.out;
  const json tree = compare("path_nw=wrong.memh");
  EXPECT_EQ(tree.at("stream"), "path_nw");
  EXPECT_EQ(tree.at("pattern"), "path_origin");
}

// Of a path of the second pass, the places are those of the image.
TEST_F(VectorTaps, OfASecondPassArePlacedInTheImage) {
  make(std::string("--taps ") + kEight);
  Values path = values("v/path_se.memh", 9);
  constexpr std::size_t pixel = kParallelism * kIterations;
  for (std::size_t i = pixel * kWidth; i < path.size() / 2; i += pixel)
    path[i + 2] ^= 1 + static_cast<int>(i / pixel % 3);
  write("wrong.memh", path, 9);
  const json tree = compare("path_se=wrong.memh");
  EXPECT_EQ(tree.at("first_difference").at("row"), kHeight - 2);
  EXPECT_EQ(tree.at("first_difference").at("column"), kWidth - 1);
  EXPECT_EQ(tree.at("first_difference").at("disparity"), 2);
  const json patterns = tree.at("streams").at(0).at("patterns");
  EXPECT_EQ(patterns.at(0).at("text"),
            "path se: it goes wrong at disparity 2, from row 14 upwards; all else that differs lies behind a "
            "pixel that "
            "does");
  EXPECT_EQ(names(patterns), (std::vector<std::string>{"path_origin", "one_disparity", "only_first_frame"}));
}

TEST_F(VectorTaps, APathThatIsMissingOrThereTwiceIsNamed) {
  for (const bool eight : {false, true}) {
    for (const int shift : {0, 2}) {
      const json manifest =
          make(fmt::format("--taps {} -s matching.sum_shift={}", eight ? kEight : "", shift));
      const int bits = (eight ? 12 : 11) - shift;
      const auto of = [&](const std::string& name) {
        const std::string order = stream(manifest, name).at("order");
        const Values path = values("v/" + name + ".memh", 9);
        Values out(path.size());
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = path[place(order, i)];
        return out;
      };
      Values sums(values("v/costs_subpixel.memh", bits).size());
      for (const json& tap : manifest.at("streams")) {
        if (!tap.contains("path")) continue;
        const Values path = of(tap.at("name"));
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += path[i];
      }
      const auto said = [&](const std::function<int(std::size_t)>& more) {
        Values got(sums.size());
        for (std::size_t i = 0; i < got.size(); ++i)
          got[i] = (sums[i] + more(i)) >> shift & ((1 << bits) - 1);
        write("sums.memh", got, bits);
        const json tree = compare("sums.memh");
        const json pattern = tree.at("streams").at(0).at("patterns").at(0);
        return fmt::format("{}: {}", pattern.at("name").get<std::string>(),
                           pattern.at("text").get<std::string>());
      };
      const Values ne = of("path_ne"), last = of(eight ? "path_sw" : "path_w");
      const std::string name = eight ? "path sw" : "path w";
      EXPECT_EQ(said([&](std::size_t i) { return -ne[i]; }), "one_path: path ne is missing");
      EXPECT_EQ(said([&](std::size_t i) { return last[i]; }),
                fmt::format("one_path: {} is there twice", name));
      EXPECT_EQ(said([&](std::size_t i) { return last[i] - ne[i]; }),
                fmt::format("one_path: {} stands in the place of path ne", name));
      const std::size_t half = sums.size() / 2;
      EXPECT_EQ(said([&](std::size_t i) { return i < half ? 0 : -ne[i]; }),
                "one_path: path ne is missing, where they differ");
      // What no path explains is said as ever.
      EXPECT_EQ(
          said([&](std::size_t i) { return i % 7 == 3 ? (i == 3 ? 1 << shift : -ne[i]) : 0; }).substr(0, 9),
          "none: non");
    }
  }
}

// Without the files of all paths, nothing is said of one.
TEST_F(VectorTaps, SumsAreComparedWithoutThem) {
  make();
  write("sums.memh", values("v/path_nw.memh", 9), 11);
  std::filesystem::remove(program_ / "v/path_w.memh");
  EXPECT_EQ(compare("sums.memh").at("stream"), "costs_subpixel");
  EXPECT_EQ(refusal("compare --vectors v --dump path_w=sums.memh"),
            "v/path_w.memh: cannot read: No such file or directory\n");
}

TEST_F(VectorTaps, WhatCannotBeAskedFor) {
  EXPECT_EQ(refusal("vectors --stage census --size 64x48 --taps --out v"),
            "--taps: nothing is taken inside census; of matching it is\n");
  EXPECT_EQ(refusal("vectors --stage matching --taps --size 64x48 --out v --set matching.parallel_rows=2"),
            "matching.parallel_rows is more than 1: the model has the values of such tokens in the order of "
            "rows, not as they lie on the wires; vectors of costs need 1\n");
  make();
  EXPECT_EQ(refusal("compare --vectors v --dump path_s=x"),
            "--dump path_s=x: matching has no stream 'path_s'; the nearest is path_w\n");
  EXPECT_EQ(refusal("compare --vectors v --dump v/path_n.memh --signals path_x.data=x"),
            "--signals path_x.data=x: matching has no stream 'path_x'; the nearest is path_w\n");
  EXPECT_EQ(refusal("compare --vectors v --dump path_w=v/path_w.memh --signals path_n.date=x"),
            "--signals: 'path_n.date=x' is not data=NAME, valid=NAME, ready=NAME or clock=NAME\n");
  std::string manifest = program_.read("v/manifest.json");
  const std::string whole = manifest;
  const auto said = [&](const std::string& old, const std::string& now) {
    program_.folder().write("v/manifest.json", std::string(whole).replace(whole.find(old), old.size(), now));
    return refusal("compare --vectors v --dump x");
  };
  EXPECT_EQ(said("\"raster\"", "\"sideways\""),
            "v/manifest.json: damaged, the order 'sideways' is not known; run parallax vectors again\n");
  EXPECT_EQ(said("\"start\": \"cost\"", "\"start\": \"x\""),
            "v/manifest.json: damaged, the start 'x' is not known; run parallax vectors again\n");
}

// One file may hold the waves of several streams.
TEST_F(VectorTaps, SignalsAreOfOneStreamOrOfAll) {
  make();
  const auto waves = [](const std::string& text, const std::string& id) {
    std::string out;
    int date = 0;
    for (const std::string& line : test::lines(text)) {
      std::string bits;
      for (const char c : line) {
        const int digit = c <= '9' ? c - '0' : c - 'a' + 10;
        for (int i = 3; i >= 0; --i) bits += digit >> i & 1 ? '1' : '0';
      }
      out += fmt::format("#{}\n0c\nb{} {}\n#{}\n1c\n", date, bits, id, date + 5);
      date += 10;
    }
    return out;
  };
  const std::string head =
      "$scope module dut $end\n$var wire 1 c tick $end\n$var wire 1 v step $end\n$var wire 72 p west $end\n"
      "$var wire 72 q other $end\n$upscope $end\n$enddefinitions $end\n#0\n1v\n";
  program_.folder().write("w.vcd", head + waves(program_.read("v/path_w.memh"), "p"));
  program_.folder().write("n.vcd", head + waves(program_.read("v/path_n.memh"), "q"));
  const test::Outcome outcome = program_(
      "compare --vectors v --dump path_w=w.vcd --dump path_n=n.vcd --signals "
      "path_n.data=dut.other,clock=dut.tick,data=dut.west,valid=dut.step");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "path_w: equal, 3072 tokens\npath_n: equal, 3072 tokens\n");
  EXPECT_EQ(refusal("compare --vectors v --dump path_w=w.vcd"),
            "w.vcd: no signal path_w_data for data of path_w; the nearest is dut.west; --signals data=NAME "
            "names another "
            "one\n");
}

}  // namespace vector_taps_test
}  // namespace parallax
