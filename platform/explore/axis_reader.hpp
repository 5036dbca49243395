// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/config/schema.hpp"
#include "platform/explore/axis.hpp"
#include "platform/explore/toml_part.hpp"

namespace parallax {

/// An entry of [vary]: one value, "start:stop:step", an array of these, or a table of from and to with step,
/// with factor, or with scale = "linear" or "log". `key`: that it is; null: an option. Throws UserError.
Axis read_axis(const TomlPart& entry, const Key* key);

}  // namespace parallax
