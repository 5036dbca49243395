// SPDX-License-Identifier: Apache-2.0
// What this program is, as every result file states it.
#pragma once

namespace parallax {

/// The release, from the project's CMakeLists.txt, for example "0.1.0".
const char* version();

/// The git revision at build time, with "-dirty" after it if files had changed; "unknown" outside a git
/// checkout.
const char* revision();

}  // namespace parallax
