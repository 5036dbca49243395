// SPDX-License-Identifier: Apache-2.0
// What is seen of a text before OpenCV's YAML parser has it.
#include "platform/input/opencv_yaml.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <random>

#include "platform/input/file_storage.hpp"
#include "tests/platform/error_of.hpp"

namespace parallax {
namespace opencv_yaml_test {

constexpr const char* kHead = "%YAML:1.0\n---\n";

std::size_t depth(const std::string& text) { return look_at_opencv_yaml(kHead + text).depth; }
std::string fault(const std::string& text) { return look_at_opencv_yaml(text).fault; }

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

TEST(OpenCvYaml, CountsBlocks) {
  EXPECT_EQ(depth(""), 0U);
  EXPECT_EQ(depth("a: 1\nb: 2\n"), 1U);
  EXPECT_EQ(depth("a:\n  b:\n     c: 1\nd: 1\n"), 3U);
  EXPECT_EQ(depth("a: - - b: -1\n"), 4U) << "in one line, too";
  EXPECT_EQ(depth("a: b: c: 1\n"), 3U);
  EXPECT_EQ(depth("a: -----\n"), 6U) << "a dash needs no blank behind it";
  EXPECT_EQ(depth("a:\n                                        b: 1\n"), 2U) << "an indentation may be wide";
  EXPECT_EQ(depth("a: !!map - - 1\n"), 3U);
}

TEST(OpenCvYaml, CountsBrackets) {
  EXPECT_EQ(depth("a: [1, [2, {b: [3]}]]\nc: [1]\n"), 5U);
  EXPECT_EQ(depth("a: [-1, -.2, -.Inf,\n   [1]]\n"), 3U);
  EXPECT_EQ(depth("a: {b: c: d: e, f: - - -}\n"), 2U) << "in brackets, colons and dashes do not nest";
  EXPECT_EQ(depth("[1, {a: 2}]\n"), 2U);
}

TEST(OpenCvYaml, CountsNothingElse) {
  const std::string colons = repeated("a: - ", 300);
  EXPECT_EQ(depth("a: \"" + colons + "[[[\"\n"), 1U);
  EXPECT_EQ(depth("a: 'it''s " + colons + "'\n"), 1U);
  EXPECT_EQ(depth("a: 1  # " + colons + "\n# " + colons + "\n  # [[[\nb: 1\n"), 1U);
  EXPECT_EQ(depth("a: b" + repeated("-", 300) + "\n"), 1U);
  EXPECT_EQ(depth("a: !str " + colons + "\n"), 1U);
  EXPECT_EQ(depth("a: {" + repeated("a: 1, ", 300) + "b: 1}\n"), 2U);
}

TEST(OpenCvYaml, SuchTextsAreRead) {
  const std::string colons = repeated("a: - ", 300);
  const cv::FileStorage file = parse_file_storage(
      kHead +
          ("note: \"" + colons + "\"\nlist: {" + repeated("a: 1, ", 300) + "b: 1}\nT: 1 # " + colons + "\n"),
      "c.yml");
  EXPECT_EQ(static_cast<std::string>(file["note"]), colons);
  EXPECT_EQ(file["list"].size(), 301U);
  EXPECT_EQ(static_cast<int>(file["T"]), 1);
}

TEST(OpenCvYaml, WhatFollowsTheDocumentIsAFault) {
  EXPECT_EQ(fault("%YAML:1.0\n---\na: 1\n...\n\n# done\n"), "");
  EXPECT_EQ(fault("%YAML:1.0\na: 1\n"), "");
  EXPECT_EQ(fault("%YAML:1.0\n---  # mine\na: 1\n"), "");
  EXPECT_EQ(fault("%YAML:1.0\n--- a: 1\n"), "line 2: text behind ---; entries begin on a line of their own");
  EXPECT_EQ(fault("%YAML:1.0\n--- a: 1\nb: 2\n"),
            "line 2: text behind ---; entries begin on a line of their own");
  EXPECT_EQ(fault("%YAML:1.0\n----\na: 1\n"),
            "line 2: text behind ---; entries begin on a line of their own");
  const std::string behind = "text behind the end of the document, which OpenCV does not read";
  EXPECT_EQ(fault("%YAML:1.0\n---\na: 1\n...\n---\nb: 2\n"), "line 5: " + behind);
  EXPECT_EQ(fault("%YAML:1.0\n---\n  a: 1\nb: 2\n"), "line 4: " + behind);
  EXPECT_EQ(fault("%YAML:1.0\n---\n{a: 1}\nb: 2\n"), "line 4: " + behind);
  EXPECT_EQ(fault("%YAML:1.0\n---\n{a: 1} b: 2\n"), "line 3: " + behind);
  EXPECT_EQ(fault("%YAML:1.0\n---\na: 1\n... b: 2\n"), "line 4: text behind ...");
  EXPECT_EQ(fault("%YAML:1.0\n---\n...\nb: 2\n"), "line 4: " + behind);
  EXPECT_EQ(
      error_of([] { parse_file_storage("%YAML:1.0\n--- a: 1\n", "c.yml"); }),
      "c.yml: not an OpenCV YAML, XML or JSON file: line 2: text behind ---; entries begin on a line of "
      "their own");
}

TEST(OpenCvYaml, ATypeBeforeANumberWithASignIsAFault) {
  const std::string list = "a type before a number with a sign, which OpenCV takes for something else";
  EXPECT_EQ(fault(std::string(kHead) + "x: 1\na: !!float -1.5\n"), "line 4: " + list);
  EXPECT_EQ(fault(std::string(kHead) + "a: [!!int +3]\n"), "line 3: " + list);
  EXPECT_EQ(fault(std::string(kHead) + "a: !!float 1.5\n"), "");
  EXPECT_EQ(fault(std::string(kHead) + "a: !float -1.5\nb: !!seq\n  - 1\nc: !!seq -\n"), "");
}

TEST(OpenCvYaml, RowsOfBase64) {
  const std::string rows = "  dt: f\n  data: !!binary |\n    AAAA\n    BB==\n";
  EXPECT_EQ(fault(kHead + ("a:\n" + rows + "b: 1\n")), "");
  EXPECT_EQ(fault(kHead + ("a:\n" + rows + "    C-CC\nb: 1\n")), "line 8: not a row of base64");
  EXPECT_EQ(fault(std::string(kHead) + "a: !!binary x\n"), "line 3: !!binary without | and rows of base64");
  EXPECT_EQ(fault(std::string(kHead) + "a: !!binary\n"), "line 3: !!binary without | and rows of base64");
  EXPECT_EQ(fault(std::string(kHead) + "# !!binary\na: 1\n"), "");
}

std::size_t depth_of(const cv::FileNode& node) {
  if (!node.isMap() && !node.isSeq()) return 0;
  std::size_t deepest = 0;
  for (const cv::FileNode& inner : node) deepest = std::max(deepest, depth_of(inner));
  return deepest + 1;
}

// Made of parts of texts. Each begins with an entry in the first column, so that nothing can be behind the
// end.
TEST(OpenCvYaml, IsAsDeepAsWhatOpenCvMakesOfIt) {
  const char* const parts[] = {"a: ", "b:",   "- ",   "-",  "1",    "x",     "[",      "]",      "{",
                               "}",   ", ",   "\n",   "\n", "\n  ", "\n   ", "\n    ", "\"q\"",  "'q'",
                               "# ",  "!!s ", "!str", ":",  " ",    ".5",    "-1, ",   "\nc: 1", "\\"};
  std::mt19937 random(7);
  int read = 0, same = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = std::string(kHead) + "a: ";
    for (std::size_t n = random() % 12; n > 0; --n) text += parts[random() % std::size(parts)];
    text += "\n";
    const OpenCvYaml seen = look_at_opencv_yaml(text);
    if (!seen.fault.empty()) continue;  // a type before a number, with which OpenCV goes on all the same
    try {
      const cv::FileStorage file(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
      if (!file.isOpened()) continue;
      const std::size_t found = depth_of(file.root());
      ASSERT_GE(seen.depth, found) << text;
      ++read;
      same += seen.depth == found ? 1 : 0;
    } catch (const cv::Exception&) {
    } catch (const std::logic_error&) {  // an entry without a name
    }
  }
  EXPECT_GT(read, 500);
  EXPECT_EQ(same, read);
}

}  // namespace opencv_yaml_test
}  // namespace parallax
