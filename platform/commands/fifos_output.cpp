// SPDX-License-Identifier: Apache-2.0
#include "platform/commands/fifos_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "platform/config/config_value.hpp"
#include "platform/config/preset.hpp"
#include "traces/number_text.hpp"

namespace parallax {
namespace {

using Json = nlohmann::ordered_json;
using Kind = FifoGoal::Kind;

constexpr const char* kNames[]{"full-rate", "rate", "deadlock-free"};

std::string rate_text(const SizedRun& run) { return quantity_text(run.period.rate(), "frames/s"); }

std::string outcome(const SizedRun& run) {
  return run.done
             ? fmt::format("{}, {} a frame, {} from exposure to the host", rate_text(run),
                           quantity_text(run.period.milliseconds(), "ms"), quantity_text(run.latency, "ms"))
             : "stuck: " + run.message;
}

Json number(double value, const char* unit) { return {{"value", value}, {"unit", unit}}; }

Json to_json(const SizedRun& run, const FifoSizing& sizing) {
  Json tree{{"status", run.done ? "done" : run.too_slow ? "too slow" : "stuck"}};
  if (run.done) {
    tree["frame_rate"] = number(run.period.rate(), "frames/s");
    tree["picoseconds"] = run.period.picoseconds;
    tree["frames"] = run.period.frames;
    tree["latency"] = number(run.latency, "ms");
    tree["limit"] = run.limit;
  } else {
    tree["message"] = run.message;
  }
  tree["storage"] = number(static_cast<double>(sizing.bits(run.depths)), "bit");
  return tree;
}

// Of the fastest run there is: what it waits for, deeper FIFOs do not help.
std::string limit_text(const FifoSizing& sizing) {
  const SizedRun& run = sizing.deep;
  if (!run.done) return "";
  if (run.limit == "none") return "no part is at work all the time in the machine with deep FIFOs";
  const bool core = run.limit == "core";
  return fmt::format("{} limits the machine with deep FIFOs ({}){}", run.limit, run.limit_key,
                     core ? "" : ": a core that waits for it gets by with less");
}

}  // namespace

std::string goal_text(const FifoSizing& sizing) {
  const FifoGoal& goal = sizing.goal;
  if (goal.kind == Kind::kDeadlockFree) return "no deadlock: all frames come out, at whatever rate";
  if (goal.kind == Kind::kRate) return fmt::format("{} fps at least", goal.rate);
  const std::string within = goal.tolerance == 0
                                 ? "to the picosecond"
                                 : fmt::format("a frame at most {} % longer", 100 * goal.tolerance);
  return fmt::format("full rate: {}, as with deep FIFOs, {}", rate_text(sizing.deep), within);
}

std::string to_text(const FifoSizing& sizing, std::int64_t frames) {
  std::string text = fmt::format("{:20}{}\n", "goal", goal_text(sizing));
  if (const std::string limit = limit_text(sizing); !limit.empty() && sizing.goal.kind != Kind::kDeadlockFree)
    text += fmt::format("{:20}{}\n", "limit", limit);
  text += fmt::format("{:18}  {:>9}  {:>5}  {:>9}  {:>10}  {:>8}  {:>10}  {:>10}\n", "stream", "kind", "bits",
                      "depth now", "high water", "smallest", "bits now", "smallest");
  for (std::size_t i = 0; i < sizing.fifos.size(); ++i) {
    const MachineFifo& fifo = sizing.fifos[i];
    const std::int64_t depth = sizing.found.depths[i];
    const std::string mark = sizing.now.done ? std::to_string(sizing.now.high_water[i]) : "-";
    text += fmt::format("{:18}  {:>9}  {:>5}  {:>9}  {:>10}  {:>8}  {:>10}  {:>10}\n", fifo.stream, fifo.kind,
                        fifo.width, fifo.depth, mark, depth, fifo.depth * fifo.width, depth * fifo.width);
  }
  text += fmt::format("{:18}  {:>9}  {:>5}  {:>9}  {:>10}  {:>8}  {:>10}  {:>10}\n", "all", "", "", "", "",
                      "", sizing.bits(sizing.now.depths), sizing.bits(sizing.found.depths));
  text += fmt::format("{:20}{}\n", "now", outcome(sizing.now));
  text += fmt::format("{:20}{}\n", "smallest", outcome(sizing.found));
  const auto stuck = std::count_if(sizing.proof.begin(), sizing.proof.end(),
                                   [](const SizedRun& run) { return !run.done && !run.too_slow; });
  const auto slow = static_cast<std::ptrdiff_t>(sizing.proof.size()) - stuck;
  text += fmt::format(
      "{:20}run with one token less in each of {} FIFOs, alone: {} times too slow, {} times stuck\n", "proof",
      sizing.proof.size(), slow, stuck);
  text += fmt::format("{:20}{} of {} frames\n", "runs", sizing.runs, frames);
  const char* head = "front";
  for (const SizedRun& point : sizing.front) {
    text += fmt::format("{:20}{:>8} bits: {}\n", head, sizing.bits(point.depths), outcome(point));
    head = "";
  }
  return text;
}

Json to_json(const FifoSizing& sizing, std::int64_t frames, const std::string& command) {
  Json tree;
  tree["command"] = command;
  tree["goal"] = {{"kind", kNames[static_cast<int>(sizing.goal.kind)]}, {"meaning", goal_text(sizing)}};
  if (sizing.goal.kind == Kind::kRate) tree["goal"]["frame_rate"] = number(sizing.goal.rate, "frames/s");
  if (sizing.goal.kind == Kind::kFullRate)
    tree["goal"]["tolerance"] = number(100 * sizing.goal.tolerance, "%");
  tree["frames"] = frames;
  tree["runs"] = sizing.runs;
  Json& fifos = tree["fifos"] = Json::array();
  for (std::size_t i = 0; i < sizing.fifos.size(); ++i) {
    const MachineFifo& fifo = sizing.fifos[i];
    const std::int64_t depth = sizing.found.depths[i];
    Json entry{
        {"stream", fifo.stream}, {"kind", fifo.kind}, {"width", fifo.width}, {"depth_now", fifo.depth}};
    if (sizing.now.done) entry["high_water_now"] = sizing.now.high_water[i];
    entry["smallest_depth"] = depth;
    entry["bits_now"] = fifo.depth * fifo.width;
    entry["smallest_bits"] = depth * fifo.width;
    fifos.push_back(std::move(entry));
  }
  tree["now"] = to_json(sizing.now, sizing);
  tree["deep"] = to_json(sizing.deep, sizing);
  tree["smallest"] = to_json(sizing.found, sizing);
  if (sizing.goal.front) tree["front"] = Json::array();
  for (const SizedRun& point : sizing.front) {
    Json entry = to_json(point, sizing);
    for (std::size_t i = 0; i < point.depths.size(); ++i)
      entry["depths"][sizing.fifos[i].stream] = point.depths[i];
    tree["front"].push_back(std::move(entry));
  }
  Json& proof = tree["proof"] = Json::array();
  for (std::size_t i = 0; i < sizing.proof.size(); ++i) {
    Json entry{{"stream", sizing.fifos[sizing.less[i]].stream},
               {"depth", sizing.proof[i].depths[sizing.less[i]]}};
    entry.update(to_json(sizing.proof[i], sizing));
    proof.push_back(std::move(entry));
  }
  return tree;
}

std::string depths_preset(const FifoSizing& sizing, const Configuration& configuration,
                          const std::string& command) {
  const std::string& preset = configuration.preset;
  const std::string parent = is_preset_path(preset) ? std::filesystem::absolute(preset).string() : preset;
  std::map<std::string, std::string> depths;
  for (std::size_t i = 0; i < sizing.fifos.size(); ++i)
    depths[sizing.fifos[i].stream + ".depth"] = std::to_string(sizing.found.depths[i]);
  std::string text = fmt::format("# {}\ndescription = {}\ninherits = {}\n", command,
                                 to_toml(ConfigValue("smallest FIFO depths: " + goal_text(sizing))),
                                 to_toml(ConfigValue(parent)));
  std::string section;
  for (const EffectiveKey& key : configuration.keys) {
    const auto depth = depths.find(key.name);
    const bool is_depth = key.section == "streams" && depth != depths.end();
    if (!is_depth && key.provenance.source != "command line") continue;
    if (key.section != section) text += fmt::format("\n[{}]\n", section = key.section);
    text += fmt::format("{} = {}\n", key.name, is_depth ? depth->second : to_toml(key.value));
  }
  return text;
}

}  // namespace parallax
