// SPDX-License-Identifier: Apache-2.0
// parallax vectors and parallax compare, as their user meets them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"
#include "tests/modules/naive_census.hpp"

namespace parallax {
namespace vectors_test {

using nlohmann::json;

constexpr const char* kSmall = "--size 64x48 -d 32 ";

class Vectors : public ::testing::Test {
 protected:
  json make(const std::string& stage, const std::string& folder, const std::string& more = "") const {
    const test::Outcome outcome =
        program_(fmt::format("vectors --stage {} {} {} --out {} --json", stage, kSmall, more, folder));
    EXPECT_EQ(outcome.code, 0) << stage << outcome.err;
    return json::parse(outcome.out);
  }
  std::vector<std::uint64_t> words(const std::string& file) const {
    std::vector<std::uint64_t> out;
    for (const std::string& line : test::lines(program_.read(file)))
      out.push_back(std::stoull(line, nullptr, 16));
    return out;
  }
  /// The one line with which a command refuses, having written nothing.
  std::string refusal(const std::string& arguments) const {
    const auto before = program_.files();
    const test::Outcome outcome = program_(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments << '\n' << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(program_.files(), before) << arguments;
    EXPECT_EQ(test::lines(outcome.err).size(), 1U) << outcome.err;
    const std::string prefix = "parallax: error: ";
    return outcome.err.substr(std::min(prefix.size(), outcome.err.size()));
  }

  test::Program program_;
};

TEST_F(Vectors, AreWhatTheDefinitionOfTheStageSays) {
  const json manifest = make("census", "v");
  EXPECT_EQ(manifest.at("stage"), "census");
  EXPECT_EQ(manifest.at("interval"), 1);
  EXPECT_EQ(manifest.at("latency"), 4);
  EXPECT_EQ(manifest.at("look_ahead"), 2 * 64 + 2);
  EXPECT_EQ(json::parse(program_.read("v/manifest.json")), manifest);
  EXPECT_EQ(
      program_.files("v"),
      (std::vector<std::string>{"census_stub.sv", "census_tb.sv", "left_codes.memh", "left_rectified.memh",
                                "manifest.json", "right_codes.memh", "right_rectified.memh"}));
  for (const std::string side : {"left", "right"}) {
    const std::vector<std::uint64_t> pixels = words("v/" + side + "_rectified.memh");
    ASSERT_EQ(pixels.size(), 64U * 48U);
    test::Grid<Gray> image(64, 48);
    for (int i = 0; i < 64 * 48; ++i) image.at(i % 64, i / 64) = static_cast<Gray>(pixels[i]);
    const test::Grid<CensusCode> codes = test::naive_census(CensusConfig{}, image);
    const std::vector<std::uint64_t> written = words("v/" + side + "_codes.memh");
    ASSERT_EQ(written.size(), 64U * 48U);
    for (int i = 0; i < 64 * 48; ++i) ASSERT_EQ(written[i], codes.at(i % 64, i / 64)) << side << ' ' << i;
  }
}

TEST_F(Vectors, OfGreyValuesAreThePixels) {
  const std::string machine = "--set census.enabled=false --set matching.cost=absolute_difference";
  const json manifest = make("matching", "v", machine);
  const json& codes = manifest.at("streams").at(0);
  EXPECT_EQ(codes.at("name"), "left_codes");
  EXPECT_EQ(codes.at("width"), 8);
  EXPECT_EQ(codes.at("fields").at(0).at("name"), "grey");
  make("census", "pixels", machine);
  EXPECT_EQ(words("v/left_codes.memh"), words("pixels/left_rectified.memh"));
}

// A stream has the same words at both of its ends, and there is a stage at each.
TEST_F(Vectors, OfEveryStageAgreeWithItsNeighbours) {
  const std::vector<std::string> machines{
      "", "--set pipeline.pixels_per_token=2",
      "--set tiles.limit=96 --size 128x48 --set tiles.left_margin=8 --set tiles.right_margin=8",
      "--set matching.paths=w,nw,n,ne,e,sw,s,se --set "
      "matching.path_storage=memory"};
  for (const std::string& machine : machines) {
    const std::string memory =
        machine.find("memory") == std::string::npos ? "" : "pack_rows unpack_rows pack_frame unpack_frame ";
    std::istringstream stages(
        "unpack_left unpack_right unpack_map map_decoder rectification census matching subpixel uniqueness "
        "consistency "
        "texture speckle gap_interpolation noise_reduction output_packing " +
        memory);
    std::map<std::string, std::string> seen;
    for (std::string stage; stages >> stage;) {
      const json manifest = make(stage, stage, machine + " --frames 2");
      EXPECT_GE(manifest.at("streams").size(), 2U) << stage;
      for (const json& stream : manifest.at("streams")) {
        const std::string content = program_.read(stage + "/" + stream.at("file").get<std::string>());
        EXPECT_EQ(static_cast<std::uint64_t>(std::count(content.begin(), content.end(), '\n')),
                  stream.at("tokens"));
        std::vector<std::string> names = stream.at("also");
        names.push_back(stream.at("name"));
        for (const std::string& name : names) {
          const auto [there, is_new] = seen.emplace(name, content);
          EXPECT_TRUE(there->second == content) << machine << ' ' << stage << ' ' << name;
        }
      }
    }
    EXPECT_GE(seen.size(), 22U);
  }
}

TEST_F(Vectors, DatesAreThoseOfTheTrace) {
  const double hz = make("census", "v", "--dates").at("clock_hz");
  ASSERT_EQ(program_(fmt::format("run {} --timing-frames 1 --no-verdict --trace csv --trace-level tokens "
                                 "--trace-from 0ms --trace-to 40ms --out r",
                                 kSmall))
                .code,
            0);
  // stream,side,frame,tile,row,begin_ps,...
  std::map<std::string, std::vector<std::int64_t>> traced;
  for (const std::string& line : test::lines(program_.read("r/trace_tokens.csv"))) {
    std::istringstream cells(line);
    std::vector<std::string> cell(6);
    for (std::string& each : cell) std::getline(cells, each, ',');
    if (cell[1] == "side") continue;
    traced[cell[0] + ' ' + cell[1]].push_back(std::llround(std::stod(cell[5]) * hz / 1e12));
  }
  for (const auto& [file, name] :
       {std::pair{"left_codes", "left_codes write"}, {"right_rectified", "right_rectified read"}}) {
    const std::vector<std::string> dates = test::lines(program_.read(fmt::format("v/{}.dates", file)));
    ASSERT_EQ(dates.size(), 64U * 48U);
    ASSERT_GE(traced[name].size(), dates.size());
    for (std::size_t i = 0; i < dates.size(); ++i)
      ASSERT_EQ(std::stoll(dates[i]), traced[name][i]) << file << ' ' << i;
  }
}

TEST_F(Vectors, ReplaceThoseOfAnEarlierCommandAndNothingElse) {
  make("census", "v");
  program_.folder().write("v/my_census.sv", "module my_census; endmodule\n");
  make("subpixel", "v");
  EXPECT_EQ(program_.files("v"),
            (std::vector<std::string>{"costs_subpixel.memh", "manifest.json", "my_census.sv",
                                      "subpixel_stub.sv", "subpixel_tb.sv", "winners.memh"}));
  program_.folder().write("w/left_codes.memh", "mine\n");
  EXPECT_EQ(refusal("vectors --stage census --size 64x48 -d 32 --out w"),
            "w/left_codes.memh would be replaced, but is no result as parallax wrote it there "
            "(.parallax_files); move "
            "it away, or choose another folder\n");
}

TEST_F(Vectors, WhatCannotBeAskedFor) {
  EXPECT_EQ(refusal("vectors --stage censor --size 64x48 --out v"),
            "--stage: there is no stage 'censor'; the nearest of this machine's is census\n");
  EXPECT_EQ(refusal("vectors --size 64x48 --out v"), "--stage is required\n");
  EXPECT_EQ(refusal("vectors --stage census --size 64x48"), "--out is required\n");
  EXPECT_EQ(refusal("vectors --stage matching --size 64x48 --out v --set matching.parallel_rows=2"),
            "matching.parallel_rows is more than 1: the model has the values of such tokens in the order of "
            "rows, not "
            "as they lie on the wires; vectors of costs need 1\n");
  EXPECT_EQ(refusal("vectors --stage census --left missing.png --right missing.png --out v"),
            "image missing.png does not exist\n");
}

TEST_F(Vectors, AreEqualToThemselvesAndDifferFromWhatWasChanged) {
  make("census", "v");
  EXPECT_EQ(
      program_("compare --vectors v --dump v/left_codes.memh --dump right_codes=v/right_codes.memh").out,
      "left_codes: equal, 3072 tokens\nright_codes: equal, 3072 tokens\n");
  std::string text = program_.read("v/right_codes.memh");
  text[7 * (64 * 10 + 3)] ^= 1;
  program_.folder().write("right.memh", text);
  const test::Outcome outcome = program_("compare --vectors v --dump right_codes=right.memh --json");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err, "");
  const json tree = json::parse(outcome.out);
  EXPECT_EQ(tree.at("stream"), "right_codes");
  EXPECT_EQ(tree.at("first_difference").at("row"), 10);
  EXPECT_EQ(tree.at("first_difference").at("column"), 3);
  EXPECT_EQ(tree.at("first_difference").at("frame"), 0);
  EXPECT_EQ(program_("compare --vectors v --dump out_right=right.memh -q").out, "");
}

// Where a filter leaves its input as it is, a circuit that does nothing is equal.
TEST_F(Vectors, OfAFilterSayHowManyTokensItChanges) {
  struct Filter {
    const char *stage, *input, *output;
  };
  for (const Filter& filter : {Filter{"uniqueness", "winners", "unique"},
                               {"speckle", "textured", "despeckled"},
                               {"noise_reduction", "interpolated", "smoothed"}}) {
    const json manifest = make(filter.stage, "v");
    const std::vector<std::uint64_t> in = words(fmt::format("v/{}.memh", filter.input));
    const std::vector<std::uint64_t> out = words(fmt::format("v/{}.memh", filter.output));
    ASSERT_EQ(in.size(), out.size());
    int changed = 0;
    for (std::size_t i = 0; i < in.size(); ++i) changed += in[i] == out[i] ? 0 : 1;
    const std::string compare = fmt::format("compare --vectors v --dump v/{}.memh", filter.output);
    const json tree = json::parse(program_(compare + " --json").out);
    EXPECT_EQ(tree.at("streams").at(0).at("changed_tokens"), changed) << filter.stage;
    EXPECT_EQ(tree.at("streams").at(0).at("input_stream"), filter.input);
    EXPECT_EQ(
        program_(compare).out,
        fmt::format("{}: equal, 3072 tokens\n", filter.output) +
            (changed >= 31 ? ""
                           : fmt::format("equal says little   the stage changes {} of 3072 tokens of {}\n",
                                         changed, filter.input)));
    std::filesystem::remove(program_ / fmt::format("v/{}.memh", filter.input));
    EXPECT_EQ(program_(compare).out, fmt::format("{}: equal, 3072 tokens\n", filter.output));
  }
}

TEST_F(Vectors, WhatCannotBeCompared) {
  make("census", "v");
  const std::string compare = "compare --vectors v --dump ";
  EXPECT_EQ(refusal("compare --vectors w --dump x"),
            "w: no folder of vectors, as it has no manifest.json; parallax vectors writes one\n");
  EXPECT_EQ(refusal(compare + "missing.memh"), "missing.memh: cannot read: No such file or directory\n");
  EXPECT_EQ(
      refusal(compare + "left_code=v/left_codes.memh"),
      "--dump left_code=v/left_codes.memh: census has no stream 'left_code'; the nearest is left_codes\n");
  EXPECT_EQ(refusal(compare + "v/left_codes.memh --signals date=x"),
            "--signals: 'date=x' is not data=NAME, valid=NAME, ready=NAME or clock=NAME\n");
  std::string manifest = program_.read("v/manifest.json");
  const std::string whole = manifest;
  manifest.replace(manifest.find("\"version\": 1"), 12, "\"version\": 9");
  program_.folder().write("v/manifest.json", manifest);
  EXPECT_EQ(
      refusal(compare + "v/left_codes.memh"),
      "v/manifest.json: vectors of version 9, this program reads version 1; run parallax vectors again\n");
  const auto damaged = [&](const std::string& key, const json& value) {
    json tree = json::parse(whole);
    tree[json::json_pointer(key)] = value;
    program_.folder().write("v/manifest.json", tree.dump());
    return refusal(compare + "v/left_codes.memh");
  };
  const std::string again = "; run parallax vectors again\n";
  EXPECT_EQ(damaged("/format", "map"), "v/manifest.json: damaged, not a manifest of vectors" + again);
  EXPECT_EQ(damaged("/size/tile_begins", json::array()),
            "v/manifest.json: damaged, an image without tiles" + again);
  EXPECT_EQ(damaged("/streams/2/fields", json::array()),
            "v/manifest.json: damaged, a stream without fields" + again);
  EXPECT_EQ(damaged("/streams/2/fields/0/bits", 65), "v/manifest.json: damaged, a field of 65 bits" + again);
  EXPECT_EQ(damaged("/streams", json::array()), "census has no output stream: --dump STREAM=FILE\n");
  program_.folder().write("v/manifest.json", "{");
  EXPECT_EQ(refusal(compare + "v/left_codes.memh").substr(0, 26), "v/manifest.json: damaged, ");
  program_.folder().write("v/manifest.json", whole);
  program_.folder().write("v/left_codes.memh", "000001\n");
  EXPECT_EQ(refusal(compare + "v/right_codes.memh"),
            "v/left_codes.memh: not the file that was written with its manifest.json; run parallax vectors "
            "again\n");
  program_.folder().write(
      "long.vcd",
      "$var wire 24 d out_right_data $end\n$var wire 1 v out_right_valid $end\n$var wire 1 c clk $end\n"
      "$enddefinitions $end\n#0\n0c\n1v\nb1000000000000000000000000 d\n#1\n1c\n");
  EXPECT_EQ(refusal(compare + "right_codes=long.vcd"), "long.vcd, line 11: 25 binary digits for 24 bits\n");
}

}  // namespace vectors_test
}  // namespace parallax
