// SPDX-License-Identifier: Apache-2.0
// Whether the blocks at both ends of a stream mean the same by a frame.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "platform/machine/wiring.hpp"
#include "tlm/error.hpp"

namespace parallax {
namespace {

bool is_circuit(const Wiring::Slot& slot) {
  return dynamic_cast<const CircuitEnds*>(slot.content.module.get()) != nullptr;
}

}  // namespace

// By its shape: of an image, all tiles of it, or of the pieces that it is cut into.
std::uint64_t Wiring::frame_tokens(const TokenShape& shape) const {
  std::uint64_t of_pass = shape.row_tokens * static_cast<std::uint64_t>(context_.height);
  if (!shape.runs.empty()) {
    of_pass = 0;
    for (const TapConfig::Run& run : shape.runs) of_pass += run.tokens;
  }
  if (shape.row_tokens == 0) return of_pass;
  std::size_t passes = 1;
  for (const auto& slot : slots_) passes = std::max(passes, slot->facts.passes);
  return of_pass * passes;
}

// What the stage at this end has of a frame by its schedule; 0 if no stage stands there.
std::uint64_t Wiring::scheduled_tokens(const End& end) const {
  const Slot& at = slot(end.port.slot);
  std::uint64_t tokens = 0;
  for (const Stage* side = at.content.stage; side != nullptr; side = side->writing_side()) {
    for (unsigned port = 0; port < Stage::kMaxPorts; ++port) {
      const std::vector<const StreamBase*> bound =
          end.is_input ? side->input_streams(port) : side->output_streams(port);
      if (std::none_of(bound.begin(), bound.end(),
                       [&](const StreamBase* stream) { return stream->basename() == end.stream; }))
        continue;
      tokens += end.is_input ? side->schedule().consumed(port) : side->schedule().produced(port);
    }
  }
  return tokens * at.facts.passes;
}

// What the other end has of a frame; without a stage there, what the stream's shape says.
FrameSize Wiring::frame_size(const End& end) const {
  FrameSize frame;
  frame.row_tokens = end.shape.row_tokens;
  for (const End& other : ends_) {
    if (other.stream == end.stream && other.is_input != end.is_input) frame.tokens = scheduled_tokens(other);
  }
  if (frame.tokens == 0) frame.tokens = end.frame_tokens;
  frame.values = frame.tokens * end.shape.format.all().size();
  if (end.shape.runs.empty()) return frame;
  std::uint64_t tokens = 0, values = 0;
  for (const TapConfig::Run& run : end.shape.runs) {
    tokens += run.tokens;
    values += run.tokens * run.values;
  }
  frame.values = frame.tokens / tokens * values;
  return frame;
}

// `usual`: the stages that are the pipeline's own, or those that replace them.
void Wiring::check_schedules(bool usual) const {
  for (const End& end : ends_) {
    const Slot& at = slot(end.port.slot);
    if (at.content.stage == nullptr || at.is_usual != usual) continue;
    const FrameSize frame = frame_size(end);
    const std::uint64_t tokens = scheduled_tokens(end);
    if (frame.tokens == 0 || tokens == frame.tokens) continue;
    const std::string row = frame.row(tokens);
    throw UserError(
        fmt::format("what stands in the slot {}: its schedule {} {} tokens of a frame {} {}, "
                    "which has {}{}{}",
                    at.name, end.is_input ? "reads" : "writes", tokens, end.is_input ? "from" : "to",
                    end.stream, frame.tokens, row.empty() ? "" : ": ", row));
  }
}

std::string Wiring::place(const std::string& stream, std::uint64_t token) const {
  for (const End& end : ends_) {
    const FrameSize frame = frame_size(end);
    if (end.stream != stream || frame.tokens == 0) continue;
    std::string text = fmt::format("frame {}", token / frame.tokens);
    if (frame.row_tokens > 0) text += fmt::format(", row {}", token % frame.tokens / frame.row_tokens);
    return text;
  }
  return {};
}

bool Wiring::has_kernel_time_blocks() const {
  return std::any_of(slots_.begin(), slots_.end(),
                     [](const auto& slot) { return slot->content.stage == nullptr && !is_circuit(*slot); });
}

void Wiring::check_frames() {
  check_schedules(false);
  check_schedules(true);
  const bool all_stages = std::all_of(slots_.begin(), slots_.end(),
                                      [](const auto& slot) { return slot->content.stage != nullptr; });
  for (const auto& slot : slots_) {
    if (is_circuit(*slot)) continue;  // they count themselves
    std::vector<std::unique_ptr<PortCount>> ports;
    for (const End& end : ends_) {
      if (end.port.slot == slot->name) ports.push_back(end.count(frame_size(end)));
    }
    FrameCount::Block block;
    block.slot = slot->name;
    block.in_kernel_time = slot->content.stage == nullptr;
    block.values_first = all_stages && !slot->is_usual;
    block.latency = slot->content.latency;
    if (context_.overlap_frames) block.look_ahead = slot->content.look_ahead;
    counts_.push_back(std::make_unique<FrameCount>(block, context_.dataflow, std::move(ports)));
  }
}

}  // namespace parallax
