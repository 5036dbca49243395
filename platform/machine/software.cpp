// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/software.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "tlm/time_resolution.hpp"

namespace parallax {
namespace {

constexpr std::int64_t kShortestPause = 1000;  // ns, before it tries again to start the core

}  // namespace

Software::Software(const sc_core::sc_module_name& name, const MachineConfig& config,
                   const MachineInput& input, const MemoryMap& memory_map, const CoreFacts& core, Send send)
    : sc_module(name),
      config_(config),
      input_(input),
      memory_map_(memory_map),
      core_(core),
      send_(std::move(send)) {
  SC_HAS_PROCESS(Software);
  SC_METHOD(start_core);
  sensitive << start_;
  dont_initialize();
}

void Software::frame_startable() {
  ++startable_;
  start_when_possible();
}

// Called whenever something may have changed that the core's next frame waits for.
void Software::start_when_possible() {
  const bool buffer =
      output_buffers_used_ < static_cast<std::int64_t>(memory_map_.number_of(BufferKind::kOutput));
  const bool frame = !starting_ && started_ < startable_ && (in_core_ == 0 || config_.software.queue_frames);
  output_full_time_.set(frame && !buffer);
  if (!frame || !buffer) return;
  starting_ = true;
  starting_time_.set(true);
  core_time_.set(true);
  ++output_buffers_used_;
  start_.notify(nanoseconds(config_.software.response_ns));
}

void Software::start_core() {
  const std::int64_t frame = started_;
  std::optional<AlgorithmParameters> parameters;
  if (!parameters_written_) parameters = algorithm_parameters(config_);
  if (input_.parameters && frame < input_.frames && frame == asked_) {
    ++asked_;  // a start that was refused is tried again with what has been written
    if (const auto changed = input_.parameters(frame)) parameters = changed;
  }
  if (parameters) driver.write_parameters(*parameters);
  parameters_written_ = true;
  const MemoryMap::FrameBuffer& images = memory_map_.images(frame);
  offers_ = true;
  const bool taken = driver.start(
      {images.left, images.right, memory_map_.map, memory_map_.output(frame), memory_map_.buffer, {}}, core_);
  offers_ = false;
  if (taken) return start_when_possible();
  ++rejected_starts_;
  start_.notify(nanoseconds(std::max<std::int64_t>(config_.software.response_ns, kShortestPause)));
}

void Software::core_started() {
  starting_ = false;
  starting_time_.set(false);
  ++in_core_;
  ++started_;
}

void Software::core_ended(std::int64_t frame) {
  core_time_.set(--in_core_ > 0 || starting_);
  if (sent_ <= frame) send(frame);
  start_when_possible();
}

void Software::send(std::int64_t frame) {
  sent_ = frame + 1;
  send_(frame, memory_map_.output(frame));
}

void Software::output_buffer_free() {
  --output_buffers_used_;
  start_when_possible();
}

std::vector<Part> Software::parts() const {
  if (config_.software.response_ns == 0) return {};
  return {{PartKind::kSoftware, "software", "software.response_ns", {Relief::kSoftware}}};
}

}  // namespace parallax
