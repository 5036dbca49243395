// SPDX-License-Identifier: Apache-2.0
#include "platform/cosim/vector_capture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "platform/config/nearest_name.hpp"
#include "platform/results/version.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

// The interval in which a stage spends most of its firings that move tokens.
std::uint64_t usual_interval(const Schedule& schedule) {
  std::map<std::uint64_t, std::uint64_t> firings;
  for (const Schedule::Segment& segment : schedule.segments()) {
    for (std::uint32_t i = 0; i < segment.phase_count; ++i) {
      const Phase& phase = schedule.phases()[segment.first_phase + i];
      if (phase.consume != 0 || phase.produce != 0) firings[phase.interval] += segment.repeat * phase.count;
    }
  }
  const auto most = std::max_element(firings.begin(), firings.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == firings.end() ? 1 : most->first;
}

VectorStream stream_of(const TokenPort& port) {
  VectorStream stream;
  stream.name = port.streams.front();
  stream.also.assign(port.streams.begin() + 1, port.streams.end());
  stream.port = port.name;
  stream.is_input = port.is_input;
  stream.file = stream.name + ".memh";
  stream.shape = port.shape;
  return stream;
}

}  // namespace

// Lines on their way to a file.
class VectorCapture::Lines {
 public:
  explicit Lines(OutputFile& file) : file_(file) { text_.reserve(kPieceBytes + kPieceBytes / 4); }

  std::string& line() { return text_; }
  void line_ends() {
    text_ += '\n';
    if (text_.size() >= kPieceBytes) flush();
  }
  void flush() {
    file_.write(text_);
    text_.clear();
  }

 private:
  static constexpr std::size_t kPieceBytes = 1u << 20;  // written at once

  OutputFile& file_;
  std::string text_;
};

struct VectorCapture::Port {
  Port(VectorStream of, const TokenPort& port, bool dates, OutputFolder& folder)
      : stream(std::move(of)),
        width(port.shape.format.width().size()),
        words(folder.open(stream.file)),
        check(width) {
    if (dates) {
      stream.dates_file = stream.name + ".dates";
      times.emplace(folder.open(stream.dates_file));
    }
    tap = port.tap([this](const WiredToken& token) { take(token); });
  }

  void take(const WiredToken& token) {
    append_hex(words.line(), token.bits, width);
    words.line_ends();
    check.add(token.bits);
    ++stream.tokens;
    if (!times) return;
    times->line() += std::to_string(token.date.count());
    times->line_ends();
  }

  VectorStream stream;
  std::size_t width;
  Lines words;
  std::optional<Lines> times;
  VectorCheck check;
  std::unique_ptr<TokenTap> tap;
};

void check_vectors(const Pipeline& pipeline, const MachineConfig& config, const std::string& stage,
                   const char* option) {
  const std::vector<std::string> all = pipeline.slots();
  if (std::find(all.begin(), all.end(), stage) == all.end()) {
    throw UserError(fmt::format("{}: there is no stage '{}'; the nearest of this machine's is {}", option,
                                excerpt(stage), nearest_name(stage, all)));
  }
  const std::vector<TokenPort> ports = pipeline.ports(stage);
  const bool has_costs = std::any_of(ports.begin(), ports.end(), [](const TokenPort& port) {
    return port.shape.first_disparity.has_value();
  });
  if (has_costs && config.matching.parallel_rows > 1) {
    throw UserError(
        "matching.parallel_rows is more than 1: the model has the values of such tokens in the order of "
        "rows, "
        "not as they lie on the wires; vectors of costs need 1");
  }
}

void check_taps(const Machine& machine, const std::string& stage, const char* option) {
  const Pipeline& pipeline = machine.pipeline();
  if (!pipeline.taps(stage).empty()) return;
  for (const std::string& other : pipeline.slots()) {
    if (!pipeline.taps(other).empty())
      throw UserError(fmt::format("{}: nothing is taken inside {}; of {} it is", option, stage, other));
  }
  throw UserError(fmt::format("{}: nothing is taken inside {}", option, stage));
}

std::set<std::string> vector_file_names(const Machine& machine, const std::string& stage,
                                        const VectorExtras& extras) {
  std::set<std::string> names{VectorManifest::kFile, stage + "_tb.sv", stage + "_stub.sv"};
  for (const TokenPort& port : machine.pipeline().ports(stage)) {
    names.insert(port.streams.front() + ".memh");
    if (extras.dates) names.insert(port.streams.front() + ".dates");
  }
  if (!extras.taps) return names;
  for (const TokenPort& tap : machine.pipeline().taps(stage)) names.insert(tap.name + ".memh");
  return names;
}

VectorManifest stage_manifest(const Machine& machine, const std::string& stage) {
  const Pipeline& pipeline = machine.pipeline();
  VectorManifest manifest;
  manifest.program = fmt::format("parallax {} ({})", version(), revision());
  manifest.stage = stage;
  manifest.width = machine.input().width;
  manifest.height = machine.input().height;
  manifest.tile_width = machine.tiles().width;
  for (const Tile& tile : machine.tiles().tiles) manifest.tile_begins.push_back(tile.begin);
  manifest.clock_hz = machine.config().clocks.core_hz;
  const SlotModule& slot = pipeline.slot(stage);
  manifest.interval = usual_interval(slot.stage->schedule());
  manifest.latency = slot.latency;
  manifest.look_ahead = slot.look_ahead;
  for (const TokenPort& port : pipeline.ports(stage)) manifest.streams.push_back(stream_of(port));
  return manifest;
}

VectorCapture::VectorCapture(const Machine& machine, const std::string& stage, const VectorExtras& extras,
                             OutputFolder& folder)
    : machine_(machine), manifest_(stage_manifest(machine, stage)) {
  for (const TokenPort& port : machine.pipeline().ports(stage))
    ports_.push_back(std::make_unique<Port>(stream_of(port), port, extras.dates, folder));
  if (!extras.taps) return;
  for (const TokenPort& tap : machine.pipeline().taps(stage)) {
    VectorStream stream = stream_of(tap);
    stream.is_tap = true;
    ports_.push_back(std::make_unique<Port>(stream, tap, false, folder));
  }
}

VectorCapture::~VectorCapture() = default;

VectorManifest VectorCapture::finish(std::int64_t frames) {
  machine_.dataflow().bring_up_to_date();
  manifest_.frames = frames;
  manifest_.streams.clear();
  for (const auto& port : ports_) {
    port->words.flush();
    if (port->times) port->times->flush();
    if (frames < 1 || port->stream.tokens % static_cast<std::uint64_t>(frames) != 0) {
      throw std::logic_error(
          fmt::format("{} tokens at {} in {} frames", port->stream.tokens, port->stream.name, frames));
    }
    port->stream.frame_tokens = port->stream.tokens / static_cast<std::uint64_t>(frames);
    port->stream.check = port->check.text();
    manifest_.streams.push_back(port->stream);
  }
  return manifest_;
}

}  // namespace parallax
