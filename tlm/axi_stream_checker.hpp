// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <systemc>

#include "tlm/clock_domain.hpp"
#include "tlm/pin_port.hpp"

namespace parallax {

/// Watches a handshake of valid and ready, as of AXI4-Stream, at pins that others drive. At each rising edge
/// of `clock`, by what is on the pins before it:
/// - `valid` is 0 in reset,
/// - `valid` stays 1, and data, `last` and `user` stay as they are, until `ready` is 1,
/// - `valid` and `ready`, and with `valid` data, `last` and `user`, are 0 or 1 in each bit (where the type
/// has
///   others: sc_logic, sc_lv).
///
/// The first breach is reported by SC_REPORT_ERROR, /parallax/axi_stream, and kept. Cycles are those of the
/// clock domain: cycle n ends with edge n + 1.
template <class Data, class Bit = bool>
class AxiStreamChecker final : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clock{"clock"};
  OptionalIn<bool> reset{"reset"};
  sc_core::sc_in<Bit> valid{"valid"};
  sc_core::sc_in<Bit> ready{"ready"};
  sc_core::sc_in<Data> data{"data"};
  OptionalIn<Bit> last{"last"};
  OptionalIn<Bit> user{"user"};

  AxiStreamChecker(const sc_core::sc_module_name& name, const ClockDomain& domain, bool reset_is_low = false)
      : sc_module(name), domain_(domain), reset_is_low_(reset_is_low) {
    SC_HAS_PROCESS(AxiStreamChecker);
    SC_METHOD(edge);
    sensitive << clock.pos();
    dont_initialize();
  }

  const std::string& breach() const { return breach_; }  ///< the first one; empty: none
  std::uint64_t tokens() const { return tokens_; }       ///< that have passed

 private:
  void edge() {
    if (is_bound(reset) && reset->read() != reset_is_low_) {
      if (!is_zero(valid.read())) report("valid is not 0 in reset");
      waits_ = false;
      return;
    }
    check_known("valid", valid.read());
    check_known("ready", ready.read());
    const bool is_valid = is_one(valid.read());
    if (waits_ && !is_valid) report("valid goes from 1 to 0 before {} was taken");
    if (is_valid) {
      check("data", data.read(), data_);
      if (is_bound(last)) check("last", last->read(), last_);
      if (is_bound(user)) check("user", user->read(), user_);
    }
    waits_ = is_valid && !is_one(ready.read());
    if (is_valid && !waits_) ++tokens_;
  }

  template <class Value>
  void check(const char* pin, const Value& value, Value& before) {
    check_known(pin, value);
    if (waits_ && !(value == before)) report(std::string(pin) + " changes before {} was taken");
    before = value;
  }
  template <class Value>
  void check_known(const char* pin, const Value& value) {
    if (!is_known(value)) report(fmt::format("{} is unknown at {{}}", pin));
  }
  void report(const std::string& what) {
    if (!breach_.empty()) return;
    const std::uint64_t now = domain_.now().size();
    breach_ =
        fmt::format("{}: {}, in cycle {}", name(),
                    fmt::format(fmt::runtime(what), fmt::format("token {}", tokens_)), now > 0 ? now - 1 : 0);
    SC_REPORT_ERROR("/parallax/axi_stream", breach_.c_str());
  }

  const ClockDomain& domain_;
  const bool reset_is_low_;
  bool waits_ = false;  // a token was offered at the edge before, and not taken
  Data data_{};
  Bit last_{};
  Bit user_{};
  std::uint64_t tokens_ = 0;
  std::string breach_;
};

}  // namespace parallax
