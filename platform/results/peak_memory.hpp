// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace parallax {

/// Largest resident size that this program has had, in units of 1024 * 1024 bytes.
double peak_memory_megabytes();

}  // namespace parallax
