// SPDX-License-Identifier: Apache-2.0
#include "tlm/time_resolution.hpp"

#include <fmt/format.h>

#include <systemc>

#include "tlm/error.hpp"

namespace parallax {

void require_picosecond_resolution() {
  const sc_core::sc_time resolution = sc_core::sc_get_time_resolution();
  if (resolution == sc_core::sc_time(1, sc_core::SC_PS)) return;
  throw UserError(
      fmt::format("SystemC's time resolution is {}; Parallax counts in picoseconds, the default: leave "
                  "sc_set_time_resolution() out",
                  resolution.to_string()));
}

}  // namespace parallax
