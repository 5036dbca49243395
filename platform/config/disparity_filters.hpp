// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "platform/config/disparity_filter.hpp"

namespace parallax {

/// The filters behind the texture filter. To add one is one line there.
DisparityFilters disparity_filters();

}  // namespace parallax
