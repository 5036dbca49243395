// SPDX-License-Identifier: Apache-2.0
#include "platform/results/deadlock_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "platform/config/stream_config.hpp"
#include "platform/machine/stuck.hpp"
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

Deadlock find_deadlock(const Machine& machine) {
  Deadlock deadlock;
  deadlock.circle = machine.dataflow().deadlock();
  deadlock.waits = machine.dataflow().waits();
  const std::uint64_t frames = machine.input().frames * machine.tiles().tiles.size();
  if (deadlock.circle.empty()) deadlock.ends = describe_ends(machine);
  if (!deadlock.circle.empty()) deadlock.remedy = smallest_remedy(machine.dataflow(), frames);
  return deadlock;
}

std::string message(const Deadlock& deadlock) {
  if (deadlock.circle.empty()) {
    return "the machine stopped before all frames were done; these wait:\n" + describe(deadlock.waits) +
           deadlock.ends + "  no circle of streams holds it up, so no depth would free it\n";
  }
  return "the machine is deadlocked; nobody in this circle can go on:\n" + describe(deadlock.circle) +
         hint(deadlock.remedy);
}

const MetricTable& deadlock_table() {
  constexpr const char* kWindow = "when it got stuck";
  static const MetricTable table{
      {"deadlock/remedy", "", "What would free the machine that got stuck.", kWindow},
      {"deadlock/<wait>/waiter", "", "Who cannot go on; the waits form a circle.", kWindow},
      {"deadlock/<wait>/stream", "", "The stream that the waiter waits on.", kWindow},
      {"deadlock/<wait>/state", "", "Whether that stream is full or empty.", kWindow},
      {"deadlock/<wait>/depth", "tokens", "Slots of that stream's FIFO.", kWindow},
      {"deadlock/<wait>/waits_for", "", "Who would have to act: the waiter of the next wait.", kWindow},
  };
  return table;
}

void add_deadlock(MetricGroup& root, const Deadlock& deadlock) {
  const MetricWriter out(root, deadlock_table());
  std::string remedy = deadlock.circle.empty() ? "no circle of streams holds it up, so no depth would free it"
                                               : hint(deadlock.remedy);
  remedy.erase(0, remedy.find_first_not_of(' '));
  if (!remedy.empty() && remedy.back() == '\n') remedy.pop_back();
  out.add("deadlock/remedy", remedy);
  const std::vector<Wait>& waits = deadlock.circle.empty() ? deadlock.waits : deadlock.circle;
  for (std::size_t i = 0; i < waits.size(); ++i) {
    const Wait& wait = waits[i];
    const MetricWriter entry = out.of(fmt::format("wait_{}", i + 1));
    entry.add("deadlock/<wait>/waiter", wait.waiter);
    entry.add("deadlock/<wait>/stream", std::string(wait.stream->basename()));
    entry.add("deadlock/<wait>/state", std::string(wait.on_full ? "full" : "empty"));
    entry.add("deadlock/<wait>/depth", std::int64_t{wait.stream->depth()});
    entry.add("deadlock/<wait>/waits_for", wait.other);
  }
}

}  // namespace parallax
