// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>

#include "platform/registers/register_map.hpp"
#include "tests/cli/markdown.hpp"
#include "tests/cli/program.hpp"
#include "tests/paths.hpp"
#include "tests/platform/temporary_folder.hpp"

namespace parallax::test {
namespace registers_command_test {

TEST(RegistersCommand, TheCheckedInTableIsWhatItPrints) {
  const Outcome outcome = Program()("registers --markdown");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, read_text(source_path("platform/REGISTERS.md")))
      << "run: parallax registers --markdown > platform/REGISTERS.md";
}

TEST(RegistersCommand, TheHeaderIsC) {
  const TemporaryFolder folder;
  const Outcome outcome = Program()("registers --header");
  folder.write("registers.h", outcome.out);
  folder.write("use.c",
               "#include \"registers.h\"\n"
               "int check[PARALLAX_STEREO_ALGORITHM_PARAMETERS_1 == 0x108 ? 1 : -1];\n"
               "int mask[PARALLAX_STEREO_ALGORITHM_PARAMETERS_1_P2_MASK == 0xff00u ? 1 : -1];\n"
               "int shift[PARALLAX_DMA_STATUS_FRAMES_DONE_SHIFT == 16 ? 1 : -1];\n");
  EXPECT_EQ(std::system(("cc -Wall -Werror -c -o " + (folder / "use.o") + " " + (folder / "use.c")).c_str()),
            0);
}

TEST(RegistersCommand, TextNamesEveryField) {
  const std::string text = Program()("registers").out;
  for (const RegisterBlock& block : register_blocks()) {
    for (const Register& reg : block.registers) {
      EXPECT_NE(text.find(std::string(block.name) + "." + reg.name), std::string::npos);
      for (const RegisterField& f : reg.fields) {
        EXPECT_NE(text.find(f.name), std::string::npos);
        EXPECT_GT(std::string(f.documentation).size(), 1u) << f.name;
      }
    }
  }
}

TEST(RegistersCommand, OneFormAtATime) {
  const Outcome outcome = Program()("registers --markdown --header");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--markdown"), std::string::npos) << outcome.err;
}

// The order of the registers is published, and so their offsets are.
TEST(RegisterMap, OffsetsAreThoseOfThePublishedOrder) {
  for (const RegisterBlock& block : register_blocks()) {
    std::uint32_t before = 0;
    for (const Register& reg : block.registers) {
      EXPECT_TRUE(reg.offset > before || reg.offset == 0) << reg.name;
      before = reg.offset;
    }
  }
  const std::vector<Register>& dma = register_blocks()[0].registers;
  ASSERT_EQ(dma.size(), 22u);
  for (std::size_t i = 0; i < dma.size(); ++i) EXPECT_EQ(dma[i].offset, 4 * i) << dma[i].name;
  EXPECT_EQ(register_blocks()[1].registers.back().offset, 0x28u);
}

}  // namespace registers_command_test
}  // namespace parallax::test
