// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <systemc>
#include <utility>

#include "tlm/dataflow.hpp"
#include "tlm/error.hpp"
#include "tlm/pin_clock.hpp"
#include "tlm/pin_config.hpp"
#include "tlm/pin_end.hpp"
#include "tlm/pin_port.hpp"
#include "tlm/stalls.hpp"
#include "tlm/stream.hpp"

namespace parallax {

/// Tokens from the output pins of a circuit into a stream, or the same into several, as its PinClock says
/// when.
///
/// `ready` is 1 in a cycle in which the stream has room; the token passes if `valid` is 1 too. A circuit
/// without the pin `ready` cannot wait, so that its clock stands where there is no room for what it has.
/// Without `valid`, its results are those that leave PinConfig::latency edges behind the tokens at its
/// inputs, all of which it then takes at the same edges.
///
/// `Data`, `Bit`: as of PinSource.
template <class T, class Data, class Bit = bool>
class PinSink final : public sc_core::sc_module, public PinEnd, public Actor {
 public:
  using Unpack = std::function<T(const Data& bits)>;

  StreamOut<T> out{"out"};
  OptionalIn<Bit> valid{"valid"};
  OptionalOut<Bit> ready{"ready"};
  sc_core::sc_in<Data> data{"data"};

  /// `unpack` gives the token of the bits on the pin. Throws UserError as PinConfig::validate().
  PinSink(
      const sc_core::sc_module_name& name, PinClock& clock, const PinConfig& config = {},
      Unpack unpack = [](const Data& bits) { return static_cast<T>(bits); })
      : sc_module(name),
        clock_(clock),
        config_(config),
        unpack_(std::move(unpack)),
        stalls_(config.stall, config.seed) {
    config.validate(this->name());
    clock.add(*this);
  }

  /// Data, valid and ready at once.
  void bind(PinSignals<Data, Bit>& pins) {
    data(pins.data);
    valid(pins.valid);
    ready(pins.ready);
  }

  /// Stalls in so many of 1000 cycles from now on, 0 to Stalls::kMost.
  void stall(std::uint64_t per_thousand) { stalls_.set(per_thousand); }
  std::uint64_t tokens() const { return tokens_; }  ///< that have been written

  void advance() override { clock_.wake(); }

 private:
  void end_of_elaboration() override {
    if (!is_bound(valid) && config_.skip > config_.flush) {
      throw UserError(std::string(name()) + ": without the pin valid, no more results can be skipped than " +
                      "tokens of zeros follow a frame");
    }
    for (int i = 0; i < out.size(); ++i) {
      require_burst_fits(name(), config_.burst, *out[i]);
      require_clock(name(), out[i]->writer_clock(), clock_.domain());
    }
    begin_frame();
  }

  void idle() override { drive_pin(ready, false); }

  void drive(Cycles cycle) override {
    if (blocks_) blocked_ += cycle - looked_ - Cycles(1);  // while the clock stood
    looked_ = cycle;
    room_ = out.can_write(cycle) && (of_burst_ > 0 || room_for_burst(cycle));
    stalled_ = of_burst_ == 0 && (cycle.size() < config_.not_ready_cycles || stalls_.next());
    drive_pin(ready, room_ && !stalled_);
  }

  void look(std::uint64_t steps) override {
    valid_ = is_bound(valid) ? is_one(valid->read()) : has_result(steps);
  }
  bool can_step(bool) const override {
    return is_bound(ready) || !valid_ || skip_ > 0 || (room_ && !stalled_);
  }

  bool pass(Cycles cycle, bool stands) override {
    blocks_ = valid_ && !room_;
    if (!valid_) return false;
    if (blocks_) blocked_ += Cycles(1);
    if (stands || (is_bound(ready) && (!room_ || stalled_))) return false;
    if (skip_ > 0) {
      --skip_;
      return true;
    }
    of_burst_ = (of_burst_ > 0 ? of_burst_ : config_.burst) - 1;
    const Cycles blocked = std::exchange(blocked_, Cycles(0));
    if (tokens_ < config_.with_values) {
      out.write(unpack_(data->read()), cycle, blocked);
    } else {
      for (StreamBase* stream : out.streams()) stream->mark_written(cycle, blocked);
    }
    ++tokens_;
    if (config_.frame_tokens > 0 && tokens_ % config_.frame_tokens == 0) begin_frame();
    return true;
  }

  bool counts_steps() const override { return !is_bound(valid); }
  bool rests() override {
    if (stalled_) return false;
    for (StreamBase* stream : out.streams()) {
      if (!stream->write_date_known(ahead())) stream->wait_for_room();
    }
    return true;
  }
  std::optional<Cycles> next() const override {
    if (room_) return std::nullopt;
    Cycles date(0);
    for (int i = 0; i < out.size(); ++i) {
      if (!out[i]->write_date_known(ahead())) return std::nullopt;
      date = std::max(date, out[i]->writable_at(ahead()));
    }
    return date;
  }

  // Without a pin that says so, what is no result is known by its place.
  void begin_frame() { skip_ = is_bound(valid) ? config_.skip : 0; }
  bool has_result(std::uint64_t steps) const {
    if (steps < config_.latency) return false;
    if (config_.frame_tokens == 0) return true;
    const std::uint64_t result = (steps - config_.latency) % (config_.frame_tokens + config_.flush);
    return result >= config_.skip && result < config_.skip + config_.frame_tokens;
  }

  std::uint64_t ahead() const { return of_burst_ > 0 ? 0 : config_.burst - 1; }
  bool room_for_burst(Cycles cycle) const {
    for (int i = 0; i < out.size(); ++i) {
      if (!out[i]->write_date_known(ahead()) || out[i]->writable_at(ahead()) > cycle) return false;
    }
    return true;
  }

  PinClock& clock_;
  const PinConfig config_;
  const Unpack unpack_;
  Stalls stalls_;
  std::uint64_t tokens_ = 0;
  std::uint64_t skip_ = 0;      // results that count for nothing before the next token of a frame
  std::uint64_t of_burst_ = 0;  // tokens that are left of a burst under way
  bool room_ = false;           // in the stream, in this cycle
  bool stalled_ = false;
  bool valid_ = false;   // the circuit has a result in this cycle
  bool blocks_ = false;  // and waits for room,
  Cycles blocked_{0};    // in so many cycles
  Cycles looked_{-1};    // the last one that was looked at
};

}  // namespace parallax
