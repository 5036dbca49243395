// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

namespace parallax {

/// What a fork of this program does first: signals end it as they would a program of its own, and it ends
/// with its parent.
void become_child_of(pid_t parent);

}  // namespace parallax
