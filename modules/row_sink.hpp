// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace parallax {

/// Receives the finished output rows of a kernel, top to bottom. The pointer is valid during the call only;
/// the row's length is the kernel's declared output width.
///
/// A kernel of one input is constructed for one configuration and image size; `push(row, emit)` takes input
/// row 0, 1, ... height-1 and calls `emit` once for each output row that is complete by then. The push of the
/// last row also emits all rows still held back by the look-ahead, and the kernel is ready for the next
/// frame. Kernels of several inputs have a push for each, or take a row of each at once.
template <class T>
using RowSink = std::function<void(const T* row)>;

}  // namespace parallax
