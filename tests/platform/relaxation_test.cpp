// SPDX-License-Identifier: Apache-2.0
// Which parts of a machine each relaxation makes faster, and that every relaxation has a name of its own.
#include "platform/evaluation/relaxation.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/timing/in_child.hpp"
#include "tests/timing/machine_bench.hpp"

namespace parallax::test {
namespace relaxation_test {

/// By a part's name, the names of what relieves it.
std::map<std::string, std::string> reliefs(const std::vector<std::string>& assignments) {
  std::istringstream in(in_child([&] {
    const MachineConfig config = preset(assignments);
    const EncodedMap map = encode(lens_map(64, 48, config.rectification.range));
    MachineInput input;
    input.width = 64;
    input.height = 48;
    input.map = &map;
    input.timing_only = true;
    const Machine machine("machine", config, input);
    sc_core::sc_start();
    std::string text;
    for (const Part& part : machine.parts()) {
      text += part.name + ":";
      for (const Relief relief : part.relieved_by) text += std::string(" ") + name_of(relief);
      text += "\n";
    }
    return text;
  }));
  std::map<std::string, std::string> all;
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(':');
    all[line.substr(0, colon)] = line.size() > colon + 2 ? line.substr(colon + 2) : "";
  }
  return all;
}

TEST(Relaxation, RelievesThePartsThatItMakesFaster) {
  const auto all = reliefs({"matching.paths=w,nw,n,ne,e,sw,s,se", "matching.path_storage=memory",
                            "camera.frame_rate=50", "matching.iterations=1"});
  const auto of = [&](const char* part) { return all.count(part) == 0 ? "no such part" : all.at(part); };
  EXPECT_EQ(of("memory"), "memory memory_clock");
  EXPECT_EQ(of("camera"), "camera camera_clock");
  EXPECT_EQ(of("camera_frame_rate"), "camera");
  EXPECT_EQ(of("dma_camera_left"), "memory dma");
  EXPECT_EQ(of("dma_link"), "memory dma");
  EXPECT_EQ(of("dma_buffer_row_read"), "memory dma buffer_port path_storage");
  EXPECT_EQ(of("software"), "software");
  EXPECT_EQ(of("core"), "core_clock software matching_interval");
  EXPECT_EQ(of("census"), "core_clock");
  EXPECT_EQ(of("unpack_left"), "core_clock");
  EXPECT_EQ(of("matching"), "core_clock matching_interval");
  for (const char* stage : {"pack_rows", "unpack_rows", "pack_frame", "unpack_frame"})
    EXPECT_EQ(of(stage), "core_clock buffer_port path_storage") << stage;
  EXPECT_EQ(of("link"), "link link_clock");
  EXPECT_EQ(of("host"), "host");
}

TEST(Relaxation, PartsThatAreNotThereAreNotRelieved) {
  const auto all = reliefs({"software.response_ns=0", "software.queue_frames=true", "link.enabled=false"});
  for (const char* part : {"software", "core", "link", "host", "camera_frame_rate", "dma_buffer_row_read"})
    EXPECT_EQ(all.count(part), 0u) << part;
  EXPECT_EQ(all.count("matching"), 1u);
}

TEST(Relaxation, NamesAreDifferent) {
  std::set<std::string> names;
  for (int i = 0; i <= static_cast<int>(Relief::kHost); ++i)
    EXPECT_TRUE(names.insert(name_of(static_cast<Relief>(i))).second) << i;
  EXPECT_EQ(names.count(""), 0u);
}

}  // namespace relaxation_test
}  // namespace parallax::test
