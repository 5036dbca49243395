// SPDX-License-Identifier: Apache-2.0
#include "platform/results/version.hpp"

#include "platform/results/revision.hpp"  // generated; this file alone includes it, so a commit recompiles nothing else

namespace parallax {

const char* version() { return PARALLAX_VERSION; }

const char* revision() { return PARALLAX_REVISION; }

}  // namespace parallax
