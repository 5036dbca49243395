// SPDX-License-Identifier: Apache-2.0
// Every reader on damaged inputs, the same ones each time; tests/fuzz/run looks for others for as long as it
// is told.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <set>
#include <string>

#include "tests/fuzz/mutation.hpp"
#include "tests/fuzz/readers.hpp"
#include "tests/paths.hpp"

namespace parallax::test {
namespace fuzz_test {

class Reader : public ::testing::TestWithParam<std::size_t> {};

TEST_P(Reader, UnderstandsOrSaysWhatIsWrong) {
  using Clock = std::chrono::steady_clock;
  const FuzzedReader& reader = fuzzed_readers()[GetParam()];
  const TemporaryFolder folder;
  const std::vector<std::string> seeds = reader.seeds();
  for (const std::string& seed : seeds) {
    ASSERT_FALSE(seed.empty());
    EXPECT_TRUE(understands(reader, folder, seed)) << reader.name << " does not understand its own seed";
  }
  // Those that build a machine or a schema for each input take a hundred times as long as the others.
  static const std::set<std::string> slow{"results", "preset", "assignment", "device", "rows"};
  const int inputs = slow.count(reader.name) != 0 ? 150 : 1000;
  Mutation mutation(1);
  int understood = 0;
  for (int i = 0; i < inputs; ++i) {
    const std::string bytes = mutation(seeds[static_cast<std::size_t>(i) % seeds.size()], seeds);
    ::alarm(60);  // what does not end is a fault, too
    const Clock::time_point began = Clock::now();
    try {
      understood += understands(reader, folder, bytes) ? 1 : 0;
    } catch (const std::exception& error) {
      ADD_FAILURE() << reader.name << " " << i << ": " << error.what() << "\n" << bytes.substr(0, 400);
    }
    EXPECT_LT(Clock::now() - began, std::chrono::seconds(20)) << reader.name << " " << i;
    ::alarm(0);
  }
  EXPECT_LT(understood, inputs) << "nothing was damaged";
}

INSTANTIATE_TEST_SUITE_P(All, Reader, ::testing::Range<std::size_t>(0, fuzzed_readers().size()),
                         [](const auto& name) { return fuzzed_readers()[name.param].name; });

}  // namespace fuzz_test
}  // namespace parallax::test
