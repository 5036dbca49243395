// SPDX-License-Identifier: Apache-2.0
// The same command writes the same bytes, whatever the process finds around it.
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/personality.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace parallax {
namespace same_bytes_test {

// What a run writes, file by file. Of timing.json, three numbers that measure this computer stay out.
std::map<std::string, std::string> results(const std::function<void()>& prepare) {
  const test::Program program;
  const test::Outcome outcome =
      program("run --size 160x96 --disparities 64 --frames 2 --out results -q", prepare);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  std::map<std::string, std::string> files;
  for (const std::string& name : program.files("results")) {
    if (name.back() != '/') files[name] = program.read("results/" + name);
  }
  auto timing = nlohmann::ordered_json::parse(files.at("timing.json"));
  for (const char* measured : {"wall_time", "speed", "peak_memory"})
    EXPECT_EQ(timing["run"].erase(measured), 1u);
  files["timing.json"] = timing.dump();
  return files;
}

TEST(SameBytes, Again) {
  const auto first = results({});
  ASSERT_EQ(first.size(), 21u);  // 9 pictures and lists a frame; the strip, profile.json and timing.json
  EXPECT_EQ(first, results({}));
}

TEST(SameBytes, InAnotherEnvironment) {
  const auto usual = results([] {
    for (const char* name : {"TZ", "LANG", "LC_ALL"}) ::unsetenv(name);
    ::personality(ADDR_NO_RANDOMIZE);  // where that is not allowed, addresses are random here too
  });
  EXPECT_EQ(usual, results([] {
              ::setenv("TZ", "Pacific/Chatham", 1);
              ::setenv("LC_ALL", "C.utf8", 1);
              ::setenv("LANG", "de_DE.UTF-8", 1);
              ::setenv("PADDING", std::string(10'007, 'x').c_str(), 1);  // moves the stack
              ::setenv("MALLOC_PERTURB_", "165", 1);                     // what is not initialised is not 0
              ::setenv("MALLOC_ARENA_MAX", "1", 1);
            }));
}

}  // namespace same_bytes_test
}  // namespace parallax
