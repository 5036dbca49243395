// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace parallax {

/// What `work` returns, done in a process of its own, as one process may have one simulation only; nothing,
/// when `interrupted` said yes, which is asked some ten times a second. What `work` throws is thrown here: a
/// UserError as one, everything else, and a process that dies, as std::runtime_error. One that ends
/// itself with another code than 0 has said why: this one ends with that code, too.
std::optional<std::string> in_own_process(const std::function<std::string()>& work,
                                          const std::function<bool()>& interrupted);

}  // namespace parallax
