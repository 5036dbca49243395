// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tlm/stream.hpp"

namespace parallax {

class FrameCount;

/// What a stream has in a frame, all tiles of it.
struct FrameSize {
  std::uint64_t tokens = 0;      ///< 0: not known; nothing is counted
  std::uint64_t row_tokens = 0;  ///< 0: tokens that know no rows
  std::uint64_t values = 0;      ///< of all tokens

  std::uint64_t values_per_token() const { return tokens == 0 ? 0 : values / tokens; }
  /// "row 47 has 95 of 96 tokens", of a frame with so many tokens; empty where tokens know no rows, and of
  /// one with all of them.
  std::string row(std::uint64_t of_frame) const;
};

/// What has passed a port of a block, by one of its streams.
class PortCount : private StreamListener {
 public:
  PortCount(StreamBase& stream, bool is_input, const FrameSize& frame)
      : stream_(stream), is_input_(is_input), frame_(frame) {}

  const StreamBase& stream() const { return stream_; }
  bool is_input() const { return is_input_; }
  const FrameSize& frame() const { return frame_; }
  std::uint64_t tokens() const { return tokens_; }  ///< read or written; counted by count_tokens()
  std::uint64_t values() const { return values_; }  ///< handed over to the stream
  Cycles last() const { return last_; }             ///< when the last token was read or written; -1: none

  /// `count` must outlive the simulation.
  void tell(FrameCount& count) { told_ = &count; }
  void count_tokens() { stream_.add_listener(*this); }
  virtual void count_values() = 0;

 protected:
  void add_values(std::size_t number);

 private:
  void written(const StreamBase& stream, Cycles cycle) override;
  void read(const StreamBase& stream, Cycles cycle) override;

  StreamBase& stream_;
  const bool is_input_;
  const FrameSize frame_;
  FrameCount* told_ = nullptr;
  std::uint64_t tokens_ = 0;
  std::uint64_t values_ = 0;
  Cycles last_{-1};
};

template <class T>
class ValueCount final : public PortCount, private RowListener<T> {
 public:
  ValueCount(Stream<T>& stream, bool is_input, const FrameSize& frame)
      : PortCount(stream, is_input, frame), values_stream_(stream) {}
  void count_values() override { values_stream_.add_row_listener(*this); }

 private:
  void row(const StreamBase&, const T*, std::size_t size) override { add_values(size); }

  Stream<T>& values_stream_;
};

/// Whether what stands in a slot writes as many tokens for a frame, and hands over as many values, as the
/// frame has. Otherwise SC_REPORT_ERROR /parallax/machine/tokens, with the stream, the frame, the row and
/// both numbers. Who goes wrong by one shifts all frames behind it, which nothing else would show.
///
/// A stage's tokens follow from its schedule (Wiring); its values of a frame must be there when it has got
/// all values for it. Of a block in kernel time tokens are counted too: when it reads the first one of a
/// frame it must have written those of the frames before, with their values, but for what follows from tokens
/// that it has read no longer than its `latency` ago. Neither may go beyond the frame of which the first
/// token, or value, has come.
class FrameCount {
 public:
  struct Block {
    std::string slot;
    bool in_kernel_time = false;
    /// Of a stage of the user's, where all upstream are stages: the values of each token must come before its
    /// date, which costs a call for each token.
    bool values_first = false;
    std::uint64_t latency = 0;     ///< cycles from reading a token to writing what follows from it
    std::uint64_t look_ahead = 0;  ///< tokens that it may hold beside; 0 where frames do not overlap
  };

  FrameCount(Block block, Dataflow& dataflow, std::vector<std::unique_ptr<PortCount>> ports);
  FrameCount(const FrameCount&) = delete;
  FrameCount& operator=(const FrameCount&) = delete;

  // Called by the ports.
  void took(const PortCount& port);
  void wrote(const PortCount& port);
  void got_values(const PortCount& port, std::uint64_t before);
  void gave_values(const PortCount& port);

 private:
  std::uint64_t whole_frames_of_values() const;
  void expect_values_of(const PortCount& output);
  void expect_tokens(std::uint64_t frames, Cycles now);
  void expect_values(std::uint64_t frames, std::uint64_t tokens_held);
  std::uint64_t held(const PortCount& output, Cycles now) const;
  void report(const PortCount& port, const std::string& what);

  const Block block_;
  Dataflow& dataflow_;
  const std::vector<std::unique_ptr<PortCount>> ports_;
  std::vector<const PortCount*> inputs_, outputs_;
  std::uint64_t begun_ = 0;  // frames of which every input has read a token
  std::uint64_t whole_ = 0;  // frames of which every input has got all values
  bool reported_ = false;
};

}  // namespace parallax
