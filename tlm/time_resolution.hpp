// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <systemc>

namespace parallax {

/// A duration in kernel time.
inline sc_core::sc_time nanoseconds(std::int64_t number) {
  return sc_core::sc_time(static_cast<double>(number), sc_core::SC_NS);
}

/// Dates are counted in picoseconds, SystemC's default resolution. Throws UserError when it has been set to
/// another one.
void require_picosecond_resolution();

}  // namespace parallax
