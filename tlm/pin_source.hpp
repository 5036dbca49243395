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

/// Tokens of a stream onto the input pins of a circuit, as its PinClock says when.
///
/// In a cycle in which the stream's next token can be read, `valid` is 1, and stays so until the token is
/// taken: in a cycle in which `ready` is 1. A circuit without the pin `ready` takes what is there. One
/// without `valid` takes a token at each edge, so that its clock stands where there is none. Inputs that stay
/// as they are (`tkeep`) are signals with an initial value.
///
/// `Data`: of the data pin, such as bool, std::uint32_t, sc_uint or sc_bv of any width. `Bit`: of the others,
/// bool or sc_logic.
template <class T, class Data, class Bit = bool>
class PinSource final : public sc_core::sc_module, public PinEnd, public Actor {
 public:
  using Pack = std::function<Data(const T& token)>;

  StreamIn<T> in{"in"};
  OptionalOut<Bit> valid{"valid"};
  OptionalIn<Bit> ready{"ready"};
  OptionalOut<Data> data{"data"};
  OptionalOut<Bit> first{"first"};        ///< the first token of a frame (`tuser`)
  OptionalOut<Bit> last{"last"};          ///< the last token of a row (`tlast`)
  OptionalOut<std::uint32_t> row{"row"};  ///< where the token lies in its frame
  OptionalOut<std::uint32_t> column{
      "column"};  ///< where it lies in its row, or in the frame if that has none

  /// `pack` gives the bits of a token as they lie on the pin. Throws UserError as PinConfig::validate().
  PinSource(
      const sc_core::sc_module_name& name, PinClock& clock, const PinConfig& config = {},
      Pack pack = [](const T& token) { return static_cast<Data>(token); })
      : sc_module(name),
        clock_(clock),
        config_(config),
        pack_(std::move(pack)),
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
  std::uint64_t tokens() const { return tokens_; }  ///< that have been taken

  void advance() override { clock_.wake(); }

 private:
  void end_of_elaboration() override {
    if ((is_bound(first) || is_bound(row)) && config_.frame_tokens == 0)
      fail("the pins first and row are of a frame, and frame_tokens is 0");
    if ((is_bound(last) || is_bound(row)) && config_.row_tokens == 0)
      fail("the pins last and row are of rows, and row_tokens is 0");
    require_burst_fits(name(), config_.burst, in.stream());
    require_clock(name(), in.stream().reader_clock(), clock_.domain());
  }

  void fail(const char* why) const { throw UserError(std::string(name()) + ": " + why); }

  void idle() override {
    drive_pin(valid, false);
    drive_pin(first, false);
    drive_pin(last, false);
  }

  void drive(Cycles cycle) override {
    if (starves_) starved_ += cycle - looked_ - Cycles(1);  // while the clock stood
    looked_ = cycle;
    there_ = flush_ > 0 || (in.can_read(cycle) && (of_burst_ > 0 || burst_is_there(cycle)));
    if (there_ && !offered_) {
      offered_ =
          of_burst_ > 0 || (cycle >= next_ && cycle.size() >= config_.not_ready_cycles && !stalls_.next());
      if (offered_) load();
    }
    drive_pin(valid, offered_);
  }
  void look(std::uint64_t) override {}
  bool can_step(bool with_all) const override { return offered_ || (is_bound(valid) && !with_all); }

  bool pass(Cycles cycle, bool stands) override {
    const bool takes = !is_bound(ready) || is_one(ready->read());
    starves_ = !there_ && takes;
    if (starves_) starved_ += Cycles(1);
    if (!offered_ || !takes || stands) return false;
    offered_ = false;
    next_ = cycle + Cycles(static_cast<std::int64_t>(config_.interval));
    if (flush_ > 0) {
      --flush_;
      return true;
    }
    of_burst_ = (of_burst_ > 0 ? of_burst_ : config_.burst) - 1;
    const Cycles starved = std::exchange(starved_, Cycles(0));
    if (has_value()) {
      in.read(cycle, starved);
    } else {
      in.stream().mark_read(cycle, starved);
    }
    if (++tokens_ == config_.frame_tokens + frame_begin_ && config_.frame_tokens > 0) {
      frame_begin_ = tokens_;
      flush_ = config_.flush;
    }
    return true;
  }

  bool counts_steps() const override { return false; }
  bool rests() override {
    if (offered_) return true;
    if (there_) return false;
    if (!in.stream().read_date_known(ahead())) in.stream().wait_for_token();
    return true;
  }
  std::optional<Cycles> next() const override {
    if (offered_ || !in.stream().read_date_known(ahead())) return std::nullopt;
    return in.stream().readable_at(ahead());
  }

  bool has_value() const { return tokens_ < config_.with_values; }
  std::uint64_t ahead() const { return of_burst_ > 0 ? 0 : config_.burst - 1; }
  bool burst_is_there(Cycles cycle) const {
    return in.stream().read_date_known(ahead()) && in.stream().readable_at(ahead()) <= cycle;
  }

  void load() {
    const bool zeros = flush_ > 0;
    const std::uint64_t token = tokens_ - frame_begin_;
    const std::uint64_t in_row = config_.row_tokens > 0 ? token % config_.row_tokens : token;
    drive_pin(data, zeros || !has_value() ? Data(0) : pack_(in.peek()));
    drive_pin(first, !zeros && token == 0);
    drive_pin(last, !zeros && in_row + 1 == config_.row_tokens);
    drive_pin(row, zeros || config_.row_tokens == 0 ? 0 : token / config_.row_tokens);
    drive_pin(column, zeros ? 0 : in_row);
  }

  PinClock& clock_;
  const PinConfig config_;
  const Pack pack_;
  Stalls stalls_;
  std::uint64_t tokens_ = 0;
  std::uint64_t frame_begin_ = 0;  // the first token of the present frame
  std::uint64_t flush_ = 0;        // tokens of zeros that are still due behind a frame
  std::uint64_t of_burst_ = 0;     // tokens that are left of a burst under way
  bool there_ = false;             // there is a token in this cycle
  bool offered_ = false;           // its pins are driven, until it is taken
  Cycles next_{0};                 // earliest cycle of the next one
  bool starves_ = false;           // it is wanted and not there,
  Cycles starved_{0};              // in so many cycles
  Cycles looked_{-1};              // the last one that was looked at
};

}  // namespace parallax
