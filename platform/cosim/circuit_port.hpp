// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "platform/cosim/circuit_framing.hpp"
#include "platform/cosim/circuit_pins.hpp"
#include "platform/cosim/dump_file.hpp"
#include "platform/cosim/stage_record.hpp"
#include "platform/cosim/vector_manifest.hpp"
#include "platform/input/circuit_options.hpp"
#include "platform/machine/circuit_end.hpp"
#include "tlm/stalls.hpp"

namespace parallax {

/// A port of a circuit between its pins and a stream of the machine. What is passed by reference must outlive
/// it.
struct CircuitPort {
  const VectorManifest& stage;
  const VectorStream& stream;
  const StageRecord::Tokens& model;  ///< what passed there in the model
  const PortPins& pins;
  const CircuitOptions& options;

  std::uint64_t pass_tokens() const { return stage.pass_tokens(stream); }
  /// Zeros that an input gets behind each pass.
  std::uint64_t pass_flush() const { return options.flush.value_or(options.latency); }
  /// Whether the token is of a frame with images.
  bool has_value(std::uint64_t token) const {
    return token / stream.frame_tokens < static_cast<std::uint64_t>(stage.frames);
  }
  /// "token 12 of frame 0"
  std::string place(std::uint64_t token) const;
  /// Of the token's first pixel in the image, or the tile; of a stream that knows rows.
  std::uint64_t column(std::uint64_t token) const;
};

/// Tokens into a circuit: valid and data are driven here, ready comes from the circuit.
class CircuitInput {
 public:
  CircuitInput(const CircuitPort& port, std::uint64_t seed);

  const CircuitPort& port() const { return port_; }
  void bind(CircuitEnd& end) { end_ = &end; }
  StreamBase& stream() const { return end_->stream(); }
  /// Whether it is known from when on the next token is there.
  bool date_known() const { return flush_ > 0 || stream().read_date_known(); }

  /// Puts what there is in this cycle on the pins; whether it is a token that was not there before. A token
  /// whose value comes later than its date, from stages that work on whole rows behind another circuit, has
  /// the recorded one.
  /// `paced`: cycles so far, without those in which the circuit's clock stood for want of room.
  bool offer(Cycles cycle, std::uint64_t paced);
  bool offered() const { return offered_; }
  /// Drives valid: `all`: whether there is a token at each input that passes together with this one.
  void present(bool all);
  /// Whether it was taken, the circuit's clock standing still or not.
  bool take(Cycles cycle, std::uint64_t paced, bool stands);

  /// Whether its pins show the circuit that there is no token, so that its clock can run: in a gap, or
  /// between rows or frames where a pin says so.
  bool shows_none(std::uint64_t paced) const;

  std::uint64_t tokens_begun() const { return tokens_ + (offered_ && flush_ == 0 ? 1 : 0); }
  /// What it waits for.
  std::string wait() const;

 private:
  void load();
  std::uint64_t position() const;
  bool in_row() const;

  const CircuitPort port_;
  const std::uint64_t pass_tokens_;
  const std::uint64_t pass_flush_;  // tokens of zeros behind each pass
  CircuitEnd* end_ = nullptr;
  Stalls stalls_;
  std::uint64_t tokens_ = 0;   // that were taken
  std::uint64_t flush_ = 0;    // tokens of zeros that are still due behind the frame
  bool offered_ = false;       // until the token is taken
  bool presented_ = false;     // valid is 1
  bool loaded_ = false;        // its bits are on the pins
  bool comes_late_ = false;    // its value
  std::uint64_t next_ = 0;     // of the cycles that pace it: the earliest of the next one
  std::uint64_t gap_end_ = 0;  // of these: in which the gap is over
  Cycles starved_{0};          // cycles in which it was wanted and not there
  std::vector<std::uint64_t> bits_;
};

/// Tokens out of a circuit: ready is driven here, valid and data come from the circuit.
class CircuitOutput {
 public:
  CircuitOutput(const CircuitPort& port, std::uint64_t seed);

  const CircuitPort& port() const { return port_; }
  /// Several have the same tokens.
  void add(CircuitEnd& end) { ends_.push_back(&end); }
  const std::vector<CircuitEnd*>& ends() const { return ends_; }
  /// Whether it is known from when on there is room.
  bool dates_known() const;

  /// Whether there is room in this cycle.
  void make_ready(Cycles cycle);
  /// Drives ready: `all`: whether there is at each output that passes together with this one.
  void present(bool all);
  bool ready() const { return ready_; }
  /// After evaluation: `always` is valid, if it has no such pin.
  void look(Cycles cycle, bool always);
  bool valid() const { return valid_; }
  /// Whether the token passed. `frames`: those that have begun, of which there may be tokens.
  bool put(Cycles cycle, bool stands, std::uint64_t frames);

  bool owes(std::uint64_t frames) const { return tokens_ < frames * port_.stream.frame_tokens; }
  /// The first breach of the handshake; empty: none.
  const std::string& breach() const { return breach_; }
  /// A breach that is seen elsewhere.
  void breaks(const std::string& what) {
    if (breach_.empty()) breach_ = what;
  }
  const CircuitFraming& framing() const { return framing_; }
  /// Whether a value was not the model's.
  bool differs() const { return differs_; }
  /// Whether a token left later than the bound allows, if there is one.
  bool late() const { return late_; }
  /// A result of a circuit without valid that is behind the last one of a frame.
  void drop() { ++dropped_; }
  /// Results behind the last one of a frame that the zeros behind it have made.
  std::uint64_t dropped() const { return dropped_; }
  /// Of frames with images, tokens that did not come, if leaving out CircuitOptions::skip results of each
  /// pass and sending fewer zeros explains it; else 0.
  std::uint64_t lost_by_skip() const;
  const Dump& dump() const { return dump_; }
  std::uint64_t tokens() const { return tokens_; }  ///< that were written
  std::string wait() const;

 private:
  void read();

  const CircuitPort port_;
  const std::uint64_t pass_tokens_;
  std::vector<CircuitEnd*> ends_;
  Stalls stalls_;
  Dump dump_;
  std::uint64_t skip_;         // tokens that count for nothing before the next one of a frame
  std::uint64_t flushed_ = 0;  // behind the last one of a frame, which may be as many as zeros were sent
  std::uint64_t dropped_ = 0;
  std::uint64_t tokens_ = 0;  // that were written
  bool ready_ = false;
  bool valid_ = false;
  bool held_ = false;          // a token was offered and not taken,
  bool first_before_ = false;  // and this was beside it
  bool last_before_ = false;
  bool differs_ = false;
  bool late_ = false;
  Cycles blocked_{0};
  std::string breach_;
  CircuitFraming framing_;
  std::vector<std::uint64_t> bits_, before_, value_;
};

}  // namespace parallax
