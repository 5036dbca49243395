// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace parallax {

/// From now on what the SystemC kernel and the model report goes to standard error, where it is a warning,
/// and is thrown as sc_report, where it is a fault.
void handle_reports();

}  // namespace parallax
