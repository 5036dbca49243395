// SPDX-License-Identifier: Apache-2.0
// Dumps as simulators and scripts write them, and what is said of damaged ones.
#include "platform/cosim/dump_file.hpp"

#include <gtest/gtest.h>

#include "modules/token_formats.hpp"
#include "tests/platform/error_of.hpp"
#include "tests/platform/temporary_folder.hpp"

namespace parallax {
namespace dump_file_test {

VectorStream stream_of(const TokenFormat& format) {
  VectorStream stream;
  stream.name = "left_codes";
  stream.port = "out_left";
  stream.shape = TokenShape(format);
  return stream;
}

class DumpFile : public ::testing::Test {
 protected:
  Dump read(const std::string& text, const TokenFormat& format, const DumpSignals& signals = {}) const {
    return read_dump(folder_.write("dump", text), stream_of(format), signals);
  }
  std::vector<std::uint64_t> words(const std::string& text, std::size_t bits = 12) const {
    const Dump dump = read(text, census_code_format(bits));
    std::vector<std::uint64_t> out;
    for (std::uint64_t i = 0; i < dump.words.size(); ++i) {
      EXPECT_FALSE(dump.words.unknown(i)) << i;
      out.push_back(dump.words.raw(i, census_code_format(bits).all().front()));
    }
    return out;
  }
  /// The line, without the folder.
  std::string error(const std::string& text, const TokenFormat& format = census_code_format(12)) const {
    const std::string line = error_of([&] { read(text, format); });
    const std::string path = folder_ / "dump";
    return line.rfind(path, 0) == 0 ? line.substr(path.size()) : line;
  }

  TemporaryFolder folder_;
};

using Words = std::vector<std::uint64_t>;

TEST_F(DumpFile, TheTextOfReadmemh) {
  EXPECT_EQ(words("001\n0a2\nFFF\n"), (Words{1, 0xA2, 0xFFF}));
  EXPECT_EQ(words("1 a2\tf_f_f"), (Words{1, 0xA2, 0xFFF}));
  EXPECT_EQ(words("// 0x00000000\n@0 001\n/* two\nlines */ 002 // end\n@2\n003\r\n"), (Words{1, 2, 3}));
  EXPECT_EQ(words("0001\n"), (Words{1}));
  EXPECT_EQ(words(""), Words{});
  const Dump dump = read("0x1\nzzz\n", census_code_format(12));
  EXPECT_TRUE(dump.words.unknown(0));
  EXPECT_TRUE(dump.words.unknown(1));
  EXPECT_EQ(dump.words.raw(0, {"", 0, 4}), 1U);
  EXPECT_EQ(read("1", census_code_format(63)).words.raw(0, {"", 0, 63}), 1U);
}

TEST_F(DumpFile, DamagedText) {
  EXPECT_EQ(error("0x1\n0x2\n"),
            ": hexadecimal words have no 0x before them here: that x is an unknown digit");
  EXPECT_EQ(error("0x123\n"),
            ", line 1: hexadecimal words have no 0x before them here: that x is an unknown digit");
  EXPECT_EQ(error(std::string("\0\1\2", 3)), ": no text: a dump is a VCD, a CSV, or the text of $readmemh");
  EXPECT_EQ(error("001\n1000\n"), ", line 2: '1000' has more than 12 bits");
  EXPECT_EQ(error("001\nhello\n"), ", line 2: 'hello' is no hexadecimal number");
  EXPECT_EQ(error("001\n@7 2\n"),
            ", line 2: '@7' is not the address of the next word, @1: the words of a dump follow each other "
            "from 0 on");
  EXPECT_EQ(error("001 /* no end"), ", line 1: a comment /* has no end");
  EXPECT_EQ(error("001 /2"), ", line 1: '/' begins neither a word nor a comment");
}

TEST_F(DumpFile, ACsvHasAColumnForEachFieldOrOneOfWords) {
  const TokenFormat pair = offset_pair_format(12);
  const Dump dump = read("cycle,left_dx,left_dy,right_dx,right_dy\n7,-1,2,0x7ff,-2048\n 9, 0,0,0,0\n", pair);
  ASSERT_EQ(dump.words.size(), 2U);
  EXPECT_EQ(dump.words.value(0, pair.all()[0]), -1);
  EXPECT_EQ(dump.words.value(0, pair.all()[2]), 2047);
  EXPECT_EQ(dump.words.value(0, pair.all()[3]), -2048);
  EXPECT_EQ(dump.cycles, (std::vector<std::int64_t>{7, 9}));
  EXPECT_EQ(words("data\n0x0a2\nfff\n"), (Words{0xA2, 0xFFF}));
  EXPECT_EQ(words("row,column,code\n0,0,12\n0,1,0xfff\n"), (Words{12, 0xFFF}));
  EXPECT_TRUE(read("code\nx\n", census_code_format(12)).words.unknown(0));
  EXPECT_EQ(words("# made by hand\ncode,valid,ready\n1,1,1\n2,0,1\n3,1,0\n# the last one\n4,1,1\n"),
            (Words{1, 4}));
}

TEST_F(DumpFile, DamagedCsv) {
  for (const char* head : {"cycle;code\n0;1\n", "code\tcycle\n1\t0\n"})
    EXPECT_EQ(error(head), ", line 1: the columns of a CSV have commas between them");
  EXPECT_EQ(error("code,valid\n0,yes\n"), ", line 2: valid = yes is neither 0 nor 1");
  EXPECT_EQ(
      error("row,value\n0,1\n"),
      ", line 1: no column code: the first line names the columns, one for each field of left_codes, or data "
      "for whole words");
  EXPECT_EQ(error("row,code\n0,1,2\n"), ", line 2: 3 columns in place of 2");
  EXPECT_EQ(error("row,code\n0,4096\n"), ", line 2: code = 4096 has no place in 12 bits");
  EXPECT_EQ(error("row,code\n0,many\n"), ", line 2: 'many' is no whole number");
  EXPECT_EQ(error("row,data\n0,\n"), ", line 2: no data");
}

constexpr const char* kHead =
    "$timescale 1ns $end\n$scope module bench $end\n"
    "$var wire 1 ! clk $end\n$var wire 12 # out_left_data [11:0] $end\n"
    "$var wire 1 $ out_left_valid $end\n$var wire 1 % out_left_ready $end\n"
    "$scope module dut $end\n$var wire 12 & out_left_data [11:0] $end\n$upscope $end\n"
    "$upscope $end\n$enddefinitions $end\n";

// What changes at an edge is there after it: the token is what lay there before.
TEST_F(DumpFile, WavesAreSampledBeforeTheEdge) {
  const Dump dump = read(std::string(kHead) +
                             "#0\n$dumpvars\n0!\nb0 #\n0$\n1%\n$end\n"
                             "#5\n1!\nb101 #\n1$\n#10\n0!\n"   // nothing was valid before this edge
                             "#15\n1!\nb110 #\n#20\n0!\n"      // 5
                             "#25\n1!\n0%\nb111 #\n#30\n0!\n"  // 6
                             "#35\n1!\n1%\n#40\n0!\n"          // not ready
                             "#45\n1!\nbx1 #\n#50\n0!\n"       // 7
                             "#55\n1!\n",                      // unknown
                         census_code_format(12));
  ASSERT_EQ(dump.words.size(), 4U);
  const TokenField code = census_code_format(12).all().front();
  EXPECT_EQ(dump.words.raw(0, code), 5U);
  EXPECT_EQ(dump.words.raw(1, code), 6U);
  EXPECT_EQ(dump.words.raw(2, code), 7U);
  EXPECT_TRUE(dump.words.unknown(3));
  EXPECT_EQ(dump.cycles, (std::vector<std::int64_t>{1, 2, 4, 5}));
}

TEST_F(DumpFile, SignalsOfOtherNames) {
  const std::string waves =
      "$var wire 1 ! ck $end\n$var wire 12 # d $end\n$var wire 1 $ v $end\n$enddefinitions $end\n"
      "#0 0! b11 # 1$ #5 1!";
  const Dump dump = read(waves, census_code_format(12), {"d", "v", "", "ck"});
  EXPECT_EQ(dump.words.size(), 1U);
  EXPECT_EQ(
      error(waves),
      ": no signal out_left_data for data of left_codes; the nearest is d; --signals data=NAME names another "
      "one");
}

// Values as VCD shortens them: what is missing above is 0, or goes on as x.
TEST_F(DumpFile, PartsOfSignals) {
  const std::string waves =
      "$var wire 1 ! ck $end\n$var wire 18 # bus [17:0] $end\n$var wire 14 % down[1:14] $end\n"
      "$var wire 16 & high [19:4] $end\n$enddefinitions $end\n"
      "#0 0! b11000000000101101 # b10000000000110 % b1010000 & #5 1! #6 0! bx01101 # #7 1! #8 0! b1 #";
  const auto code_of = [&](const DumpSignals& signals, std::size_t bits) {
    const Dump dump = read(waves, census_code_format(bits), signals);
    EXPECT_EQ(dump.words.size(), 2U);
    EXPECT_EQ(dump.words.unknown(dump.words.size() - 1), signals.data.rfind("bus[1", 0) == 0);
    return dump.words.raw(0, census_code_format(bits).all().front());
  };
  EXPECT_EQ(code_of({"bus[11:0]", "bus[0]", "", "ck"}, 12), 45U);
  EXPECT_EQ(code_of({"bus[15:4]", "bus[0]", "", "ck"}, 12), 0x802U);
  EXPECT_EQ(code_of({"bus[3:0]", "bus[0]", "bus[2]", "ck"}, 4), 13U);
  EXPECT_EQ(code_of({"down[14:11]", "bus[0]", "", "ck"}, 4), 6U);
  EXPECT_EQ(code_of({"down[14:3]", "bus[0]", "", "ck"}, 12), 6U);
  EXPECT_EQ(code_of({"high[11:8]", "bus[0]", "", "ck"}, 4), 5U);
  const std::string path = folder_ / "dump";
  const auto refused = [&](const std::string& data) {
    return error_of([&] { read(waves, census_code_format(12), {data, "bus[0]", "", "ck"}); });
  };
  EXPECT_EQ(refused("bus[18:7]"), path + ": --signals data=bus[18:7]: bus has the bits [17:0]");
  EXPECT_EQ(refused("high[11:0]"), path + ": --signals data=high[11:0]: high has the bits [19:4]");
  EXPECT_EQ(refused("bus[12"), "--signals data=bus[12: a signal is NAME, NAME[BIT] or NAME[HIGH:LOW]");
  EXPECT_EQ(refused("bus[12:0]"), path + ": bus has 13 bits, left_codes has 12");
}

// Of 12 bits in two bytes the others are nobody's, as they are where the circuit runs in the machine.
TEST_F(DumpFile, AnAxiStreamIsWholeBytes) {
  const std::string values = "$enddefinitions $end\n#0 0! bx111000000101101 # 1$ #5 1! #6 0! b1 # #7 1!";
  const std::string head = "$var wire 1 ! clk $end\n$var wire 1 $ out_left_tvalid $end\n$var wire 16 # ";
  const Dump dump = read(head + "out_left_tdata $end\n" + values, census_code_format(12));
  ASSERT_EQ(dump.words.size(), 2U);
  EXPECT_EQ(dump.words.raw(0, census_code_format(12).all().front()), 45U);
  EXPECT_FALSE(dump.words.unknown(0));
  EXPECT_EQ(dump.words.raw(1, census_code_format(12).all().front()), 1U);
  EXPECT_EQ(error(head + "out_left_data $end\n" + values), ": out_left_data has 16 bits, left_codes has 12");
  EXPECT_EQ(error(head + "out_left_tdata $end\n" + values, census_code_format(8)),
            ": out_left_tdata has 16 bits, left_codes has 8");
}

// Some simulators write each bit of a bus as a signal of its own, in any order.
TEST_F(DumpFile, ABusMayBeWrittenBitByBit) {
  const std::string head = "$var wire 1 ! clk $end\n$var wire 1 $ out_left_valid $end\n";
  const std::string bits =
      "$var wire 1 a out_left_data [2] $end\n$var wire 1 b out_left_data[1] $end\n"
      "$var wire 1 c out_left_data [0] $end\n$enddefinitions $end\n";
  const TokenFormat code = census_code_format(3);
  const Dump dump = read(head + bits + "#0 0! 1$ 1a 0b 1c #5 1! #6 0! 1b #7 1! #8 0! xa #9 1!", code);
  ASSERT_EQ(dump.words.size(), 3U);
  EXPECT_EQ(dump.words.raw(0, code.all().front()), 5U);
  EXPECT_EQ(dump.words.raw(1, code.all().front()), 7U);
  EXPECT_TRUE(dump.words.unknown(2));
  EXPECT_EQ(error(head + "$var wire 1 a out_left_data [2] $end\n$var wire 1 b out_left_data [0] $end\n"
                         "$enddefinitions $end\n",
                  code),
            ": out_left_data may be out_left_data or out_left_data: say so much of the name that it is one");
}

TEST_F(DumpFile, SignalsOfOneNameAreToldApart) {
  const std::string waves =
      "$var wire 1 ! clk $end\n$var wire 1 $ v $end\n$scope module a $end\n$var wire 12 # d $end\n"
      "$upscope $end\n$scope module b $end\n$var wire 12 % d $end\n$upscope $end\n$scope module c $end\n"
      "$var wire 1 ! clk $end\n$upscope $end\n$enddefinitions $end\n#0 0! 1$ b1 # b10 % #5 1!";
  const TokenFormat code = census_code_format(12);
  EXPECT_EQ(read(waves, code, {"a.d", "v", "", "clk"}).words.raw(0, code.all().front()), 1U);
  EXPECT_EQ(read(waves, code, {"b.d", "v", "", "clk"}).words.raw(0, code.all().front()), 2U);
  EXPECT_EQ(error_of([&] {
              read(waves, code, {"d", "v", "", "clk"});
            }),
            (folder_ / "dump") + ": d may be a.d or b.d: say so much of the name that it is one");
}

TEST_F(DumpFile, WavesWithoutATokenSayWhy) {
  EXPECT_EQ(error(std::string(kHead) + "#0\n0!\n#5\nx!\n"),
            ": bench.clk never goes from 0 to 1; --signals clock=NAME names another clock");
  EXPECT_EQ(error(std::string(kHead) + "#0 0! 1$ 0% #5 1! #6 0! 0$ #7 1!"),
            ": no token of left_codes: at 2 edges of bench.clk, bench.out_left_valid was 1 at 1, "
            "bench.out_left_ready at 0");
  const std::string token = std::string(kHead) + "#0 0! x$ x% #5 1! #6 0! b1 # 1$ 1% #7 1! #8 0! ";
  EXPECT_EQ(error(token + "x$\n#9 1!"), ", line 13: bench.out_left_valid is unknown in cycle 2");
  EXPECT_EQ(error(token + "x%\n#9 1!"), ", line 13: bench.out_left_ready is unknown in cycle 2");
}

TEST_F(DumpFile, DamagedWaves) {
  EXPECT_EQ(error("$var port [7:0] <0 d $end\n"),
            ", line 1: an extended VCD of $dumpports, which is not read; $dumpvars makes a VCD");
  EXPECT_EQ(error(std::string(kHead) + "#0\n1*\n"), ", line 13: '*' is no signal's identifier");
  EXPECT_EQ(error("$var wire 1"), ", line 1: a $var without width, identifier and name");
  EXPECT_EQ(error("$scope module x"), ", line 1: the file ends within a command, without $end");
  EXPECT_EQ(error("$timescale 1ns $end\n"), ", line 2: the file ends before $enddefinitions");
  EXPECT_EQ(error("$timescale 1ns $end\n12\n"), ", line 2: '12' where a command such as $var is expected");
  EXPECT_EQ(error("$enddefinitions $end\n"), ": no signals in this VCD");
  EXPECT_EQ(error(kHead, census_code_format(13)), ": bench.out_left_data has 12 bits, left_codes has 13");
  EXPECT_EQ(error(std::string(kHead) + "#0\nb1"), ", line 13: the file ends within a value");
  EXPECT_EQ(error(std::string(kHead) + "#0\n1\n"), ", line 13: '1' is no change of a value");
}

}  // namespace dump_file_test
}  // namespace parallax
