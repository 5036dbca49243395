// SPDX-License-Identifier: Apache-2.0
#include "platform/results/deadlock_message.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/config/stream_config.hpp"
#include "tlm/deadlock.hpp"

namespace parallax {
namespace {

// The FIFO of a DMA engine has no key in tokens.
std::string depth_key(const StreamBase& stream) {
  const std::vector<std::string>& names = pipeline_stream_names();
  const bool has_key = std::find(names.begin(), names.end(), stream.basename()) != names.end();
  return has_key ? fmt::format("streams.{}.depth", stream.basename())
                 : fmt::format("a depth of {}", stream.name());
}

std::string hint(const Remedy& remedy) {
  if (!remedy.obstacle.empty()) return fmt::format("  no depth is known to free it: {}\n", remedy.obstacle);
  if (remedy.depths.size() == 1) {
    const Remedy::Depth& depth = remedy.depths[0];
    return fmt::format("  {} = {} would free it (now {})\n", depth_key(*depth.stream), depth.tokens,
                       depth.stream->depth());
  }
  std::vector<std::string> all;
  for (const Remedy::Depth& depth : remedy.depths) {
    all.push_back(
        fmt::format("{} = {} (now {})", depth_key(*depth.stream), depth.tokens, depth.stream->depth()));
  }
  return fmt::format("  {} would free it together, none of them alone\n", fmt::join(all, " and "));
}

}  // namespace

std::string deadlock_message(const Machine& machine) {
  const Dataflow& dataflow = machine.dataflow();
  const std::vector<Wait> circle = dataflow.deadlock();
  if (circle.empty()) {
    return "the machine stopped before the host had all frames; these wait:\n" + describe(dataflow.waits()) +
           "  no circle of streams holds it up, so no depth would free it\n";
  }
  const auto frames = static_cast<std::uint64_t>(machine.input().frames) * machine.tiles().tiles.size();
  return "the machine is deadlocked; nobody in this circle can go on:\n" + describe(circle) +
         hint(smallest_remedy(dataflow, frames));
}

}  // namespace parallax
