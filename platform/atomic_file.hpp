// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

namespace parallax {

/// Writes a file under a temporary name beside its target and renames it when every byte is on the file
/// system: a reader sees the old file or the new one, never a part. Throws UserError with one line when the
/// folder does not take it or the disk is full; then nothing of it is left. A target that is a device or a
/// pipe is written directly.
void write_atomically(const std::filesystem::path& target, const std::vector<unsigned char>& bytes);

}  // namespace parallax
