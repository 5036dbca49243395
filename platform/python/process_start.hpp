// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace parallax {

/// In a process that is a copy of Python's, before it simulates: what the program's main() and command line
/// do, and what a process with one thread needs that is a copy of one with several.
void prepare_process();

}  // namespace parallax
