// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

namespace parallax {

/// A pin that may be left unbound: the circuit does not have it.
template <class Value>
using OptionalIn = sc_core::sc_port<sc_core::sc_signal_in_if<Value>, 1, sc_core::SC_ZERO_OR_MORE_BOUND>;
template <class Value>
using OptionalOut = sc_core::sc_port<sc_core::sc_signal_inout_if<Value>, 1, sc_core::SC_ZERO_OR_MORE_BOUND>;

/// What lies between a circuit and an end of a stream where both valid and ready are there.
template <class Data, class Bit = bool>
struct PinSignals {
  sc_core::sc_signal<Data> data;
  sc_core::sc_signal<Bit> valid, ready;
};

/// Whether it is bound; from the end of elaboration on.
template <class Interface, int Count, sc_core::sc_port_policy Policy>
bool is_bound(const sc_core::sc_port<Interface, Count, Policy>& pin) {
  return pin.size() > 0;
}

template <class Value, class Given>
void drive_pin(OptionalOut<Value>& pin, const Given& value) {
  if (is_bound(pin)) pin->write(Value(value));
}

/// Whether a pin of one bit is 1; unknown is not.
inline bool is_one(bool value) { return value; }
inline bool is_one(const sc_dt::sc_logic& value) { return value == sc_dt::SC_LOGIC_1; }
inline bool is_zero(bool value) { return !value; }
inline bool is_zero(const sc_dt::sc_logic& value) { return value == sc_dt::SC_LOGIC_0; }

/// Whether each bit is 0 or 1, which only types of four values can say no to.
template <class Value>
bool is_known(const Value&) {
  return true;
}
inline bool is_known(const sc_dt::sc_logic& value) { return value.is_01(); }
template <int Width>
bool is_known(const sc_dt::sc_lv<Width>& value) {
  return value.is_01();
}

}  // namespace parallax
