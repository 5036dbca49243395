// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace parallax {

/// Dates are counted in picoseconds, SystemC's default resolution. Throws UserError when it has been set to
/// another one.
void require_picosecond_resolution();

}  // namespace parallax
