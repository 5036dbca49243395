// SPDX-License-Identifier: Apache-2.0
// Inputs that are too deep, too long or without end: one line that quotes little, and soon.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

#include "tests/cli/program.hpp"
#include "tests/fuzz/calibration_seeds.hpp"

namespace parallax {
namespace input_limits_test {

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

class InputLimits : public ::testing::Test {
 protected:
  std::string error(const std::string& arguments, const std::function<void()>& prepare = {}) const {
    const test::Outcome outcome = program_(arguments, prepare);
    EXPECT_EQ(outcome.code, 2) << arguments.substr(0, 200) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(test::lines(outcome.err).size(), 1U) << outcome.err;
    EXPECT_LT(outcome.err.size(), 600U) << outcome.err.substr(0, 1000);
    return outcome.err;
  }
  std::string preset(const std::string& text) const {
    program_.folder().write("p.toml", text);
    return error("config -p p.toml");
  }

  test::Program program_;
};

TEST_F(InputLimits, PresetsThatAreTooDeepOrTooLong) {
  EXPECT_EQ(preset(repeated("a.", 100) + "a = 1\n"),
            "parallax: error: p.toml: " + repeated("a.", 30) +
                "...: a key of more than 64 parts, such as no key has\n");
  EXPECT_NE(preset("[" + repeated("\"x\" . ", 100) + "x]\n").find("a key of more than 64 parts"),
            std::string::npos);
  EXPECT_NE(preset("a = {" + repeated("'b'.", 100) + "c = 1}\n").find("a key of more than 64 parts"),
            std::string::npos);
  for (const char* opening : {"[", "{a="}) {
    EXPECT_NE(preset("a = " + repeated(opening, 300)).find("p.toml:1: "), std::string::npos);
  }
  const std::string key(1'000'000, 'k');
  EXPECT_EQ(preset(key + " = 1\n").substr(0, 115),
            "parallax: error: p.toml:1: unknown key " + key.substr(0, 60) + "...; the nearest");
  preset("matching.p1 = \"" + key + "\"\n");
  preset("matching.p1 = {value = 1, " + key + " = 2}\n");
  preset("inherits = \"" + key + "\"\n");
  preset(repeated("#", 17 << 20));
}

TEST_F(InputLimits, WordsOfTheCommandLine) {
  const std::string word(100'000, 'w');
  for (const std::string& arguments :
       std::vector<std::string>{"run --set " + word + "=1",
                                "run --set matching.p1=" + word,
                                "run --set " + word,
                                "run --" + word,
                                word,
                                "run " + word,
                                "run --size " + word,
                                "run --frames " + word,
                                "run --timing-only --vary " + word + "=1",
                                "config -p " + word,
                                "run --out o --trace " + word,
                                "run --out o --trace csv --trace-level " + word,
                                "map encode -o m --identity " + word,
                                "memory x --config " + word,
                                "run --set matching.p1=" + repeated("[", 300),
                                "run --set matching.p1=" + repeated("a.", 100),
                                "run -d 9223372036854775807",
                                "run --frames 99999999999999999999999",
                                "run --size 99999999999x16",
                                "run --set clocks.core_hz=99999999999999999999999999",
                                "run --set clocks.core_hz=1e999"}) {
    error(arguments);
  }
}

TEST_F(InputLimits, ChainsOfPresets) {
  for (int i = 0; i < 200; ++i)
    program_.folder().write(std::to_string(i) + ".toml",
                            "inherits = \"./" + std::to_string(i + 1) + ".toml\"\n");
  program_.folder().write("200.toml", "");
  EXPECT_EQ(
      error("config -p ./0.toml"),
      "parallax: error: ./64.toml: inherits from more than 64 presets one after another, from ./0.toml on\n");
  EXPECT_EQ(program_("config -p ./140.toml").code, 0);
}

TEST_F(InputLimits, MapsOfMorePixelsThanMemoryHolds) {
  EXPECT_EQ(error("map encode --identity 65535x65535 -o m"),
            "parallax: error: a rectification map of 65535x65535 px: it may have 67108864 at most, as "
            "8192x8192 has\n");
  error("map encode --identity 99999999999x3 -o m");
}

TEST_F(InputLimits, CalibrationsThatAreTooDeep) {
  const std::string xml = "<?xml version=\"1.0\"?>\n<opencv_storage>";
  for (const std::string& text :
       {"{\"a\": " + repeated("[", 250), "{\"a\": " + repeated("{\"a\": ", 250),
        "%YAML:1.0\n---\na: " + repeated("[", 250), "%YAML:1.0\n---\na: " + repeated("{a: ", 250),
        xml + repeated("<a>", 250), xml + repeated("<a><!--</a>-->", 250),
        "%YAML:1.0\n---\na\": " + repeated("[", 250), "%YAML:1.0\n---\na: " + repeated("- ", 250),
        "%YAML:1.0\n---\n" + repeated("a: ", 250), "%YAML:1.0\n---\na[: " + repeated("- a: ", 250),
        "%YAML:1.0\n---\na #: " + repeated("- ", 250)}) {
    program_.folder().write("c.yml", text);
    for (const char* option : {"--calibration", "--maps"}) {
      EXPECT_EQ(error("map encode -o m " + std::string(option) + " c.yml"),
                "parallax: error: c.yml: nested more than 200 deep, such as no calibration or map is\n");
    }
  }
  program_.folder().write("c.yml", "cam0:\n  a: " + repeated("[", 1000));
  EXPECT_EQ(error("map encode -o m --calibration c.yml"),
            "parallax: error: c.yml: nested more than 500 deep, such as no calibration is\n");
  std::string steps = "%YAML:1.0\n---\n";
  for (int i = 0; i < 260; ++i) steps += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  program_.folder().write("c.yml", steps);
  EXPECT_NE(error("map encode -o m --calibration c.yml").find("nested more than 200 deep"),
            std::string::npos);
}

TEST_F(InputLimits, AKeyWithoutAName) {
  program_.folder().write("c.yml", "%YAML:1.0\n---\na:\n   b: 3\n   :scol 4\n");
  for (const char* option : {"--calibration", "--maps"}) {
    EXPECT_EQ(error("map encode -o m " + std::string(option) + " c.yml"),
              "parallax: error: c.yml: not an OpenCV YAML, XML or JSON file: an entry has no name\n");
  }
}

// Whatever is quoted of a calibration, it is little.
TEST_F(InputLimits, CalibrationsOfLongWords) {
  const std::string word(1'000'000, 'w');
  const auto damaged = [&](std::string text, const std::string& what) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), word);
  };
  const std::vector<std::string> seeds = test::calibration_seeds();
  for (const std::string& text :
       {damaged(seeds[0], "pinhole"), damaged(seeds[1], "pinhole"), damaged(seeds[1], "46.5"),
        damaged(seeds[2], "5.0e+01"), damaged(seeds[3], "5.1e+01"), damaged(seeds[4], "0 31.5"),
        damaged(seeds[1], "[46.5"), word + ": 1\n" + word + ": 2\n" + seeds[1], word}) {
    program_.folder().write("c.yml", text);
    error("map encode -o m --size 64x48 --calibration c.yml");
  }
  program_.folder().write("l.yml", test::ros_camera("0."));
  program_.folder().write("r.yml", damaged(test::ros_camera("-4.5"), "plumb_bob"));
  error("map encode -o m --calibration l.yml r.yml");
  error("map encode -o m --calibration l.yml l.yml --cameras " + word.substr(0, 100'000));
}

TEST_F(InputLimits, TruthsOfLongWords) {
  ASSERT_EQ(program_("scene --rectified --size 64x48 --disparities 32 --out g").code, 0);
  for (const std::string& text :
       {"Pf\n" + std::string(100'000, 'w') + " 48\n-1\n", "Pf " + std::string(60, '\x1b') + "\n",
        "\x93NUMPY\x01" + std::string(1, '\0') + std::string(1, '\xB8') + std::string(1, '\x0B') +
            "{'descr': '<f" + std::string(2800, '4') + "', 'fortran_order': False, 'shape': (48, 64)}" +
            std::string(1000, ' ')}) {
    program_.folder().write("t", text);
    error("run -d 32 --left g/left.png --right g/right.png --ground-truth t");
  }
}

TEST_F(InputLimits, TracesWithoutEnd) {
  EXPECT_EQ(error("memory /dev/zero --config ddr3-1066-x32"),
            "parallax: error: /dev/zero:1: has more than 1000 characters\n");
  program_.folder().write("t.csv",
                          "time_ns,rw,addr,bytes\n1,R,0x0,64\n2,R," + std::string(900, '9') + ",64\n");
  EXPECT_EQ(error("memory t.csv --config ddr3-1066-x32").rfind("parallax: error: t.csv:3: addr is '999", 0),
            0U);
}

TEST_F(InputLimits, PublishedValuesThatNoNumberCanBeDividedBy) {
  for (const char* published : {"1e-320", "1e-40", "1e300", "inf", "nan", "0", "-1"}) {
    program_.folder().write(
        "rows.toml",
        "[[row]]\nname = \"a\"\nsource = \"b\"\nsize = \"64x48\"\nmetric = \"frame_time\"\nunit = \"ms\"\n"
        "least = 0\nmost = 1\npublished = " +
            std::string(published) + "\n");
    EXPECT_EQ(error("validate --rows ./rows.toml"),
              "parallax: error: ./rows.toml:9: published must be a number above 0\n");
  }
}

TEST_F(InputLimits, ClosedDescriptorsTakeNoFile) {
  for (const int descriptor : {STDIN_FILENO, STDERR_FILENO}) {
    const test::Outcome outcome =
        program_("run --timing-only --size 63x48 -d 32 --out out --trace json --no-verdict",
                 [=] { ::close(descriptor); });
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(program_.read("out/trace.json").front(), '{');
    EXPECT_EQ(program_.read("out/trace.json").find("note"), std::string::npos);
  }
  const test::Outcome closed = program_("config", [] { ::close(STDOUT_FILENO); });
  EXPECT_EQ(closed.code, 2);
  EXPECT_EQ(closed.err, "parallax: error: cannot write to standard output\n");
  EXPECT_EQ(program_("config",
                     [] {
                       for (const int descriptor : {0, 1, 2}) ::close(descriptor);
                     })
                .code,
            2);
}

}  // namespace input_limits_test
}  // namespace parallax
