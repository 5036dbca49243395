// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "traces/metric_table.hpp"

namespace parallax {

/// A number of a run, or of an estimate, of which an exploration can ask for bounds. `where`: for the
/// message, "spec.toml:12". Throws UserError: there is none of this name (the nearest is said), or it needs
/// images.
const MetricInfo& require_metric(const std::string& name, const std::string& where);

/// Likewise, one that has a least and a most, and is of this device if it is of one (empty: of none).
void require_number(const std::string& name, const std::string& device, const std::string& where);

}  // namespace parallax
