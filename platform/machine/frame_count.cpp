// SPDX-License-Identifier: Apache-2.0
#include "platform/machine/frame_count.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace parallax {
namespace {

constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();

std::uint64_t frames_begun(std::uint64_t number, std::uint64_t of_frame) {
  return (number + of_frame - 1) / of_frame;
}

}  // namespace

std::string FrameSize::row(std::uint64_t of_frame) const {
  if (row_tokens == 0 || of_frame >= tokens) return {};
  return fmt::format("row {} has {} of {} tokens", of_frame / row_tokens, of_frame % row_tokens, row_tokens);
}

void PortCount::add_values(std::size_t number) {
  const std::uint64_t before = values_;
  values_ += number;
  is_input_ ? told_->got_values(*this, before) : told_->gave_values(*this);
}

void PortCount::written(const StreamBase&, Cycles cycle) {
  if (is_input_) return;
  ++tokens_;
  last_ = cycle;
  told_->wrote(*this);
}

void PortCount::read(const StreamBase&, Cycles cycle) {
  if (!is_input_) return;
  ++tokens_;
  told_->took(*this);
  last_ = cycle;
}

FrameCount::FrameCount(Block block, Dataflow& dataflow, std::vector<std::unique_ptr<PortCount>> ports)
    : block_(std::move(block)), dataflow_(dataflow), ports_(std::move(ports)) {
  for (const auto& port : ports_) {
    if (port->frame().tokens == 0) continue;
    (port->is_input() ? inputs_ : outputs_).push_back(port.get());
  }
  if (inputs_.empty()) return;  // nothing says when a frame begins
  for (const auto& port : ports_) {
    if (port->frame().tokens == 0) continue;
    port->tell(*this);
    port->count_values();
    if (block_.in_kernel_time || (block_.values_first && !port->is_input())) port->count_tokens();
  }
}

// The first token of a frame at the last one of the inputs ends the frames before.
void FrameCount::took(const PortCount& port) {
  std::uint64_t begun = kAll;
  for (const PortCount* input : inputs_) {
    begun = std::min(begun, frames_begun(input->tokens(), input->frame().tokens));
  }
  if (begun == begun_) return;
  begun_ = begun;
  if (begun > 1) expect_tokens(begun - 1, port.stream().reader_clock().now());
}

void FrameCount::wrote(const PortCount& port) {
  if (!block_.in_kernel_time) {
    expect_values_of(port);
    return;
  }
  std::uint64_t begun = 0;
  for (const PortCount* input : inputs_) {
    // What could be read in this cycle was there before the edge, as what is written is.
    const std::uint64_t seen = input->tokens() + (input->stream().can_read() ? 1 : 0);
    begun = std::max(begun, frames_begun(seen, input->frame().tokens));
  }
  if (port.tokens() <= begun * port.frame().tokens) return;
  if (begun == 0) return report(port, "writes a token before it has read one");
  report(port, fmt::format("writes more than the {} tokens of frame {}, before it reads one of frame {}",
                           port.frame().tokens, begun - 1, begun));
}

// Of all tokens that a stage has written, unless they are of a frame without images.
void FrameCount::expect_values_of(const PortCount& output) {
  const FrameSize& frame = output.frame();
  const std::uint64_t each = frame.values_per_token();
  if (output.values() >= output.tokens() * each) return;
  const std::uint64_t number = (output.tokens() - 1) / frame.tokens;
  for (const PortCount* input : inputs_) {
    if (frames_begun(input->values(), input->frame().values) <= number) return;
  }
  const std::uint64_t before = number * frame.tokens;
  const std::uint64_t values = output.values() - std::min(output.values(), before * each);
  report(output, fmt::format("has handed over {} values for the first {} tokens of frame {}, which have {} "
                             "each: {}",
                             values, output.tokens() - before, number, each, frame.row(values / each)));
}

// Tokens that may still be on their way through the block.
std::uint64_t FrameCount::held(const PortCount& output, Cycles now) const {
  if (block_.look_ahead > 0) return block_.look_ahead + block_.latency;
  const Cycles latency(static_cast<std::int64_t>(block_.latency));
  Cycles settled = output.last();
  for (const PortCount* input : inputs_) settled = std::max(settled, input->last());
  const StreamBase& stream = output.stream();
  const bool had_room = stream.write_date_known() && stream.writable_at() + latency < now;
  return had_room && settled + latency < now ? 0 : block_.latency;
}

void FrameCount::expect_tokens(std::uint64_t frames, Cycles now) {
  std::uint64_t most_held = 0;
  for (const PortCount* output : outputs_) {
    const FrameSize& frame = output->frame();
    const std::uint64_t most = held(*output, now);
    most_held = std::max(most_held, most);
    if (output->tokens() + most >= frames * frame.tokens) continue;
    const std::uint64_t number = output->tokens() / frame.tokens;
    const std::uint64_t of_frame = output->tokens() % frame.tokens;
    const std::string row = frame.row(of_frame);
    report(*output, fmt::format("has written {} of the {} tokens of frame {} when it reads one of frame {}"
                                "{}{}; {} may be on their way (SlotModule::latency)",
                                of_frame, frame.tokens, number, frames, row.empty() ? "" : ": ", row, most));
  }
  expect_values(std::min(frames, whole_frames_of_values()), most_held);
}

std::uint64_t FrameCount::whole_frames_of_values() const {
  std::uint64_t whole = kAll;
  for (const PortCount* input : inputs_) whole = std::min(whole, input->values() / input->frame().values);
  return whole;
}

void FrameCount::expect_values(std::uint64_t frames, std::uint64_t tokens_held) {
  for (const PortCount* output : outputs_) {
    const FrameSize& frame = output->frame();
    const std::uint64_t each = frame.values_per_token();
    if (output->values() + tokens_held * each >= frames * frame.values) continue;
    const std::uint64_t number = output->values() / frame.values;
    const std::uint64_t of_frame = output->values() % frame.values;
    std::string more = frame.row(of_frame / std::max<std::uint64_t>(each, 1));
    // Groups of another size, all of them.
    if (each > 1 && number == 0 && frames == 1 && of_frame % frame.tokens == 0)
      more = fmt::format("that is {} a token in place of {}", of_frame / frame.tokens, each);
    report(*output, fmt::format("has handed over {} of the {} values of frame {}{}{}", of_frame, frame.values,
                                number, more.empty() ? "" : ": ", more));
  }
}

void FrameCount::got_values(const PortCount& port, std::uint64_t before) {
  if (block_.in_kernel_time) return;
  // Before the stage gets them: those of the frames before have gone through it, unless they are in this
  // piece.
  std::uint64_t begun = before / port.frame().values;
  for (const PortCount* input : inputs_) {
    if (input == &port) continue;
    const std::uint64_t of_other = frames_begun(input->values(), input->frame().values);
    begun = std::min(begun, of_other - std::min<std::uint64_t>(of_other, 1));
  }
  expect_values(std::min(begun, whole_), 0);
  const std::uint64_t whole = whole_frames_of_values();
  if (whole == whole_) return;
  whole_ = whole;
  dataflow_.post([this, whole] { expect_values(whole, 0); });
}

void FrameCount::gave_values(const PortCount& port) {
  std::uint64_t begun = 0;
  for (const PortCount* input : inputs_) {
    begun = std::max(begun, frames_begun(input->values(), input->frame().values));
  }
  const FrameSize& frame = port.frame();
  if (port.values() <= begun * frame.values) return;
  if (begun == 0) return report(port, "hands over values before it has got any");
  const std::uint64_t each = frame.values_per_token();
  report(port, fmt::format("hands over more than the {} values of frame {}{}", frame.values, begun - 1,
                           each > 1 ? fmt::format(", {} a token", each) : ""));
}

// Once: what follows a fault is no news.
void FrameCount::report(const PortCount& port, const std::string& what) {
  if (reported_) return;
  reported_ = true;
  SC_REPORT_ERROR("/parallax/machine/tokens", fmt::format("what stands in the slot {} {}, at stream {}",
                                                          block_.slot, what, port.stream().basename())
                                                  .c_str());
}

}  // namespace parallax
