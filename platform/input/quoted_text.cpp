// SPDX-License-Identifier: Apache-2.0
#include "platform/input/quoted_text.hpp"

#include "tlm/error.hpp"

namespace parallax {

std::string in_quotes(std::string_view text) { return "\"" + excerpt(text) + "\""; }

}  // namespace parallax
