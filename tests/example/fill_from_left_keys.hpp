// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/config/schema.hpp"
#include "tests/example/fill_from_left.hpp"

namespace parallax {

inline void describe(Schema& schema, FillFromLeftConfig& config) {
  schema.integer("fill_from_left.reach", config.reach, {0, 255}, "px", "How far a disparity is carried.",
                 chosen("an example"));
}

}  // namespace parallax
